"""Declarations of a feature of the viewer: its actions, its panels, and how it shows changes.

A feature is a folder below `hexmend_app.features` with a module `feature` whose class `Feature...` derives from
`Feature`. The window finds it there; menus, tool bar, palette, the page of keys and `docs/keys.md` are made from its
declarations. Features do not import each other: they meet in the session.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from enum import Enum
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QMenu, QWidget

from hexmend_app.host import Host
from hexmend_app.state.session.state_part import StatePart

if TYPE_CHECKING:
    from pathlib import Path

    from hexmend_app.canvas.canvas import Canvas

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
    """Return True: for an action that is always enabled."""
    return True


class ActionFace(NamedTuple):
    """Text, icon and help of an action on buttons."""

    text: str
    icon: str
    help: str


@dataclass(frozen=True, kw_only=True)
class Action:
    """A command of the user interface.

    Parameters
    ----------
    id : str
        Identifies it for other features, settings and tests.
    text : str
        Text in the menu, with an ampersand before its mnemonic; without one, or where another action of the menu has
        the same, a letter is assigned.
    handle : callable
        Called to carry it out; for an action with `checked`, with the new state.
    menu : str
        One of `MENUS`; "" for an action with only keys, the palette and the context menu of the view.
    keys : str
        Portable key sequence, "" for none.
    icon : str
        A Material Design icon's name, "" for none.
    help : str
        One sentence, shown as tooltip and in the page of keys.
    enabled : callable
        Returns True if it can be used now.
    checked : callable, optional
        Returns True if it is on; None for an action that is not checkable.
    title : callable, optional
        Returns the present text, if it changes.
    face : callable, optional
        Returns the present text, icon and help on buttons, if they change.
    tool : str
        Text in the tool bar; "" for an action that is not in it.
    needs_mesh : bool
        It is disabled while no mesh is open.
    part : int
        Section of the menu; sections are separated by lines.
    exclusive : bool
        Exactly one of the exclusive actions of its menu is on.
    in_view : bool
        It is in the context menu of the view.
    submenu : QMenu, optional
        A menu below it.
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
    face: Callable[[], ActionFace] | None = None
    tool: str = ""
    needs_mesh: bool = True
    part: int = 0
    exclusive: bool = False
    in_view: bool = False
    submenu: QMenu | None = None


class PanelPlace(Enum):
    """Default place of a panel."""

    TOOLS = "tools"  # docks at the top right: they change the mesh or the picture
    FACTS = "facts"  # docks at the bottom right: figures and charts
    DRAWER = "drawer"  # docks below the view, which open and close together
    BELOW = "below"  # a line below the view, not a dock
    EMPTY = "empty"  # instead of the view while no mesh is open


@dataclass(frozen=True, kw_only=True)
class Panel:
    """A widget of a feature with a place in the window.

    Parameters
    ----------
    id : str
        Identifies it in settings and tests.
    title : str
        Shown on its tab and in the menu View.
    widget : QWidget
    place : PanelPlace
    tab : str
        Title of the dock that it shares with other panels, stacked; "" for a dock with this panel only.
    order : int
        Order of docks, and of panels in a dock.
    help : str
        One sentence that describes it.
    scrolls : bool
        It is put into a scroll area; for a widget that does not scroll itself.
    """

    id: str
    title: str
    widget: QWidget
    place: PanelPlace
    tab: str = ""
    order: int = 50
    help: str = ""
    scrolls: bool = False


class Feature(QObject):
    """A feature of the viewer.

    Parameters
    ----------
    host : Host
    """

    #: Features are built in this order, and by default listed in menus and refreshed in it.
    order: ClassVar[int] = 50
    #: Order of a feature's actions in each menu.
    menu_order: ClassVar[int]
    #: Order in which features are refreshed.
    refresh_order: ClassVar[int]

    def __init_subclass__(cls, **options: Any) -> None:
        super().__init_subclass__(**options)
        cls.menu_order = vars(cls).get("menu_order", cls.order)
        cls.refresh_order = vars(cls).get("refresh_order", cls.order)

    def __init__(self, host: Host):
        super().__init__(host.dialog_parent)
        self.host = host
        self.session = host.session

    @property
    def canvas(self) -> Canvas | None:
        """The 3D view; None until `canvas_ready` is called."""
        return self.host.canvas

    def actions(self) -> Sequence[Action]:
        """The actions of this feature."""
        return ()

    def panels(self) -> Sequence[Panel]:
        """The panels of this feature."""
        return ()

    def states(self) -> Sequence[StatePart]:
        """The parts of this feature's state that session files store."""
        return ()

    def canvas_ready(self, canvas: Canvas) -> None:
        """Use the 3D view, which has just been built."""

    def refresh(self) -> None:
        """Show the present session; called once for all changes in a turn of the event loop."""

    def refresh_iteration(self) -> None:
        """Show the newest iteration of a run that goes on, where the feature shows something of it.

        Called instead of `refresh`, up to thirty times a second, as long as nothing else has changed.
        """

    def program_started(self) -> None:
        """Begin what only the program does, not every window: called once all features are built."""

    def may_leave(self) -> bool:
        """Return True if the open mesh may be closed; may ask the user."""
        return True

    def save_and_wait(self, path: str | Path) -> bool:
        """Save the mesh, or with a session's suffix the session, and wait; return True if it was written."""
        saving = self.session.commands.save_in_background(path)
        waited = self.host.wait_until(f"{saving.path.name} is being saved.", lambda: saving.over)
        return waited and saving.error is None

    def close(self) -> None:
        """End all work: the window is closing."""


@dataclass
class ChangeTracker:
    """Remembers what was shown, so that only changes are shown again."""

    _last: dict[str, tuple] = field(default_factory=dict)

    def changed(self, subject: str, *now: object) -> bool:
        """Return True if the values differ from those of the last call with the same key, and remember them.

        Parameters
        ----------
        what : str
            The key.
        *now : object
            Compared by `==`; arrays, which are never written to, by identity.
        """
        before = self._last.get(subject)
        self._last[subject] = now
        return before is None or len(before) != len(now) or any(map(_differ, before, now))

    def forget(self) -> None:
        """Report every key as changed at its next call."""
        self._last.clear()


def _differ(before: object, now: object) -> bool:
    if before is now:
        return False
    arrays = any(getattr(one, "ndim", 0) for one in (before, now))  # numpy is not imported before the first picture
    return arrays or before != now


__all__ = [
    "MENUS",
    "Action",
    "ActionFace",
    "ChangeTracker",
    "Feature",
    "Host",
    "Panel",
    "PanelPlace",
    "StatePart",
    "always",
]
