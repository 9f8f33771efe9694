"""What a feature of the viewer declares: its actions, its panels, and how it shows what has changed.

A feature is a folder below `hexmend_app.features` with a module `feature` whose class `Feature...` derives from
`Feature`. The window finds it there, and from its one declaration come menus, tool bar, palette, the page of keys and
`docs/keys.md`. Features import no sibling: they meet in the session.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from enum import Enum
from typing import TYPE_CHECKING, Any, ClassVar, Protocol

from PySide6.QtCore import QObject
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QMenu, QWidget

if TYPE_CHECKING:
    from pathlib import Path

    from hexmend_app.canvas.canvas import Canvas
    from hexmend_app.state.session import Session
    from hexmend_app.widgets.busy import Busy
    from hexmend_app.widgets.message_bar import MessageBar

#: The menus, in their order; behind a slash, a menu within one.
MENUS = (
    "File",
    "Edit",
    "Smooth",
    "Timeline",
    "View",
    "View/Camera",
    "View/Up",
    "View/Panels",
    "View/Theme",
    "Hex",
    "Compare",
    "Help",
)


def always() -> bool:
    """For an action that can be done at any time."""
    return True


@dataclass(frozen=True, kw_only=True)
class Action:
    """Something that the user can do.

    Parameters
    ----------
    id : str
        What other features and tests know it by.
    text : str
        In its menu, with the letter that Alt is to reach behind an ampersand; where that is another's, or none is
        named, the menu gives it one.
    handle : callable
        Does it. That of an action with `checked` takes whether it is to be on.
    menu : str
        One of `MENUS`; "" for what is reached by its keys, by the palette and in the menu of the view alone.
    keys : str
        Portable key sequence, "" for none.
    icon : str
        A Material Design icon's name, "" for none.
    help : str
        One sentence, shown as tooltip and in the page of keys.
    enabled : callable
        Whether it can be done now.
    checked : callable, optional
        Whether it is on; None for what is done and over.
    title : callable, optional
        What the text is now, where it changes.
    tool : str
        Its word in the tool bar; "" keeps it out.
    needs_mesh : bool
        Not to be done while no mesh is open.
    part : int
        Which part of its menu it stands in; parts are parted by lines.
    exclusive : bool
        Of the actions of its menu, one is on.
    in_view : bool
        Stands in the menu that a right click in the view opens.
    submenu : QMenu, optional
        A menu that stands below it.
    """

    id: str
    text: str
    handle: Callable[..., Any]
    menu: str = ""
    keys: str = ""
    icon: str = ""
    help: str = ""
    enabled: Callable[[], bool] = always
    checked: Callable[[], bool] | None = None
    title: Callable[[], str] | None = None
    tool: str = ""
    needs_mesh: bool = True
    part: int = 0
    exclusive: bool = False
    in_view: bool = False
    submenu: QMenu | None = None


class Place(Enum):
    """Where a panel stands."""

    TOOLS = "tools"  # the right column's upper tabs: what changes something
    FACTS = "facts"  # its lower tabs: what tells something
    DRAWER = "drawer"  # tabs below the view, that open and close
    BELOW = "below"  # a line of its own below the view
    EMPTY = "empty"  # in the view's place while no mesh is open


@dataclass(frozen=True, kw_only=True)
class Panel:
    """A widget of a feature that the window gives room.

    Parameters
    ----------
    id : str
        What settings and tests know it by.
    title : str
        On its tab, and in the menu View.
    widget : QWidget
    place : Place
    tab : str
        Title of the tab that it shares with others, one below the other; "" for a tab of its own.
    order : int
        Tabs, and panels within one, stand in this order.
    help : str
        One sentence on what it shows.
    scrolls : bool
        Whether it is put into an area that scrolls; not what scrolls by itself.
    """

    id: str
    title: str
    widget: QWidget
    place: Place
    tab: str = ""
    order: int = 50
    help: str = ""
    scrolls: bool = False


class Host(Protocol):
    """What a feature has of the window.

    Attributes
    ----------
    dialog_parent : QWidget
        The window, before which dialogs stand.
    session : Session
        The window's state, in which features meet.
    canvas : Canvas or None
        The 3D view, which comes later than the rest.
    messages : MessageBar
        Says what went wrong, and what has been done.
    busy : Busy
        Says what is going on, and offers a way out.
    """

    dialog_parent: QWidget
    session: Session
    canvas: Canvas | None
    messages: MessageBar
    busy: Busy

    def action(self, id: str) -> QAction:
        """The action of some feature, once all are there."""

    def show_panel(self, id: str) -> None:
        """Bring a panel to the front, and unfold what it stands in."""

    def offer_panel(self, id: str) -> None:
        """Bring a panel to the front of what it stands in, unfolded or not: the view keeps its room."""

    def in_front(self, id: str) -> bool:
        """Whether a panel can be seen."""

    def may_leave(self) -> bool:
        """Whether every feature lets the open mesh go."""

    def wait_until(self, text: str, over: Callable[[], bool], leave: str = "") -> bool:
        """Wait until something is over, with `leave` on a button that does not wait; whether to go on then."""

    def refresh_soon(self) -> None:
        """Have everything refreshed before the event loop's next turn is over."""

    @property
    def stem(self) -> str:
        """What a file that is saved is proposed to be called, without what tells its kind."""

    def said(self, failure: str, act: Callable[[], object], success: str = "") -> bool:
        """Do something and say `success`, or, under the title `failure`, why it was not done; whether it was."""


class Feature(QObject):
    """A part of what the viewer can do.

    Parameters
    ----------
    host : Host
    """

    #: Features are built, and stand in menus, in this order.
    order: ClassVar[int] = 50

    def __init__(self, host: Host):
        super().__init__(host.dialog_parent)
        self.host = host
        self.session = host.session

    @property
    def canvas(self) -> Canvas | None:
        """The 3D view, which comes later than the rest; `canvas_ready` is called as it does."""
        return self.host.canvas

    def actions(self) -> Sequence[Action]:
        """What the user can do."""
        return ()

    def panels(self) -> Sequence[Panel]:
        """What has a place in the window."""
        return ()

    def canvas_ready(self, canvas: Canvas) -> None:
        """Take the 3D view."""

    def refresh(self) -> None:
        """Show the session as it is now: called once after whatever has changed in a turn of the event loop."""

    def may_leave(self) -> bool:
        """Whether the open mesh may be given up for another, or the window closed; may ask."""
        return True

    def save_and_wait(self, path: str | Path) -> bool:
        """Write the mesh as it is now, or under a session's suffix the session, and wait; whether it was written."""
        saving = self.session.commands.save_in_background(path)
        waited = self.host.wait_until(f"{saving.path.name} is being saved.", lambda: saving.over)
        return waited and saving.error is None

    def close(self) -> None:
        """End what is going on: the window is about to go."""


@dataclass
class Seen:
    """What was shown last, so that only what has changed is shown anew."""

    _last: dict[str, tuple] = field(default_factory=dict)

    def another(self, what: str, *now: object) -> bool:
        """Whether something is another than at the last call for it; from then on it is what was seen.

        Parameters
        ----------
        what : str
            Names what is looked at.
        *now : object
            Compared by `==`, which for states and other objects with an identity means the same object. Arrays are
            never written to: they too are the same where they are the same object.
        """
        before = self._last.get(what)
        self._last[what] = now
        return before is None or len(before) != len(now) or any(map(_differ, before, now))

    def forget(self) -> None:
        """Show everything anew."""
        self._last.clear()


def _differ(before: object, now: object) -> bool:
    if before is now:
        return False
    arrays = any(getattr(one, "ndim", 0) for one in (before, now))  # the first paint knows no numpy to ask
    return arrays or before != now


__all__ = ["MENUS", "Action", "Feature", "Host", "Panel", "Place", "Seen", "always"]
