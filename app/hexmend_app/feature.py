"""Base class of the features of the viewer, and declarations of their actions and panels.

A feature is a folder below `hexmend_app.features` with a module `feature` whose class `Feature...` derives from
`Feature`; a package outside the tree names its class in the entry points `hexmend.features`. The window builds menus,
tool bar, palette, and the page of keys from its declarations. Features do not import each other: they communicate
through the session.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from enum import Enum
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QMenu, QWidget

from hexmend.errors import HexmendError
from hexmend_app.host import Host as Host
from hexmend_app.state.session.state_part import StatePart as StatePart
from hexmend_app.translation import tr

if TYPE_CHECKING:
    from hexmend.run.recipe import Recipe
    from hexmend.smoothers import Smoother
    from hexmend_app.canvas.canvas import Canvas

#: Menus in order; a name after a slash is that of a submenu.
MENUS = (
    "File",
    "Edit",
    "Smooth",
    "Timeline",
    "View",
    "View/Show",
    "View/Camera",
    "View/Up",
    "View/Panels",
    "Hex",
    "Compare",
    "Help",
)


def always() -> bool:
    """Return True: for an action that is always enabled."""
    return True


class ButtonAppearance(NamedTuple):
    """Text, icon and help of an action on buttons."""

    text: str
    icon: str
    help: str


@dataclass(frozen=True, kw_only=True)
class Action:
    """Command of the user interface.

    Parameters
    ----------
    id : str
        Identifies it for other features, settings and tests.
    text : str
        Text in the menu, with an ampersand before its mnemonic if it has one.
    handle : callable
        Called to execute the action; for an action with `checked`, with the new state.
    menu : str
        One of `MENUS`; "" for an action that is only in the palette and the context menu of the view, or has only keys.
    keys : str
        Portable key sequence, "" for none.
    icon : str
        Name of a Material Design icon, "" for none.
    help : str
        One sentence, shown as tooltip and in the page of keys.
    enabled : callable
        Returns True if the action is available now.
    checked : callable, optional
        Returns True if it is on; None for an action that is not checkable.
    title : callable, optional
        Returns the current text, if it changes.
    appearance : callable, optional
        Returns the current text, icon and help on buttons, if they change.
    tool : str
        Text in the tool bar; "" to omit it there.
    momentary : bool
        The button in the tool bar keeps the action checked only while it is pressed.
    needs_mesh : bool
        The action is disabled while no mesh is open.
    section : int
        Number of the section of the menu; sections are separated by lines.
    exclusive : bool
        The action belongs to the exclusive actions of its menu, of which exactly one is checked.
    in_view : bool
        The action is in the context menu of the view.
    submenu : QMenu, optional
        Menu that is added after the action.
    """

    id: str
    text: str
    handle: Callable[..., Any]
    menu: str = ""
    keys: str = ""
    icon: str = ""
    help: str = ""
    enabled: Callable[..., bool] = always
    checked: Callable[..., bool] | None = None
    title: Callable[[], str] | None = None
    appearance: Callable[..., ButtonAppearance] | None = None
    tool: str = ""
    momentary: bool = False
    needs_mesh: bool = True
    section: int = 0
    exclusive: bool = False
    in_view: bool = False
    submenu: QMenu | None = None


class PanelPlace(Enum):
    """Default place of a panel."""

    TOOLS = "tools"  # docks at the top right, for tools that change the mesh or the picture
    FACTS = "facts"  # docks at the bottom right, for figures and charts
    DRAWER = "drawer"  # docks below the view, each with a button in the bottom row of the window; closed at first
    BAR = "bar"  # bars right below the view, not docks
    EMPTY = "empty"  # in place of the view while no mesh is open


@dataclass(frozen=True, kw_only=True)
class Panel:
    """Widget of a feature with a place in the window.

    Parameters
    ----------
    id : str
        Identifies it in settings and tests.
    title : str
        Text on its tab and in the menu View.
    widget : QWidget
    place : PanelPlace
    tab : str
        Title of the dock that it shares with other panels, stacked; "" for a dock with this panel only.
    order : int
        Order of docks, and of panels in a dock.
    help : str
        One sentence that describes it.
    scrolls : bool
        Add a scroll area, for a widget that does not scroll itself.
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
    """Base of the features of the viewer.

    Parameters
    ----------
    host : Host
    """

    def __init__(self, host: Host):
        super().__init__(host.dialog_parent)
        self.host = host
        self.session = host.session
        self._seen = ChangeTracker()  # what `refresh` has shown

    @property
    def canvas(self) -> Canvas | None:
        """The 3D view; None until `canvas_ready` is called."""
        return self.host.canvas

    def actions(self) -> Iterable[Action]:
        """Return the actions of this feature."""
        return ()

    def panels(self) -> Iterable[Panel]:
        """Return the panels of this feature."""
        return ()

    def states(self) -> Iterable[StatePart]:
        """Return the parts of the state of this feature that session files store."""
        return ()

    def canvas_ready(self) -> None:
        """Connect to the 3D view; called once when `canvas` exists."""

    def refresh(self) -> None:
        """Show the current session; called once for all changes in a turn of the event loop.

        Iterations of an active run are followed five times a second.
        """

    def program_started(self) -> None:
        """Start tasks of the program, rather than of every window; called once all features are built."""

    def confirm_close(self) -> bool:
        """Return True if the open mesh may be closed; may ask the user."""
        return True

    def memory_suffices(self, *works: Smoother | Recipe) -> bool:
        """Return True if memory will suffice for methods on the current mesh, or the user starts them all the same."""
        from hexmend_app.widgets.dialogs.questions import ask_short_of_memory

        shortage = self.session.commands.shortage(works)
        if shortage is None:
            return True
        remedy = shortage.remedy(tr("isolate a region and pin the rest (Hex menu)"))
        return ask_short_of_memory(self.host.dialog_parent, shortage.problem, remedy)

    def try_and_report(self, failure: str, act: Callable[[], object]) -> bool:
        """Call `act` and return True, or show an error with the title `failure`."""
        try:
            act()
        except HexmendError as error:
            self.host.messages.show_error(failure, str(error))
            return False
        return True

    def write_file(self, subject: str, path: str | Path, write: Callable[[Path], object]) -> bool:
        """Write a file and tell so with buttons that open it and its folder, or show the error.

        Parameters
        ----------
        subject : str
            What is written, at the beginning of a sentence.
        path : path-like
        write : callable
            Writes the file; may raise `HexmendError`.

        Returns
        -------
        bool
            True if the file was written.
        """
        path = Path(path)
        if not self.try_and_report(tr("{subject} not saved", subject=subject), lambda: write(path)):
            return False
        self.host.messages.show_written(tr("{subject} saved to {path}", subject=subject, path=path), path)
        return True

    def close(self) -> None:
        """Stop all tasks; called when the window closes."""


@dataclass
class ChangeTracker:
    """Record of the values that a feature has shown, to update only what has changed."""

    _last: dict[str, tuple] = field(default_factory=dict)

    def changed(self, key: str, *values: object) -> bool:
        """Return True if the values have changed since the last call with the same key, and store them.

        Parameters
        ----------
        key : str
        *values : object
            Compared by `==`; arrays, which are never written to, by identity.
        """
        before = self._last.get(key)
        self._last[key] = values
        return before is None or len(before) != len(values) or any(map(_differ, before, values))

    def forget(self) -> None:
        """Let the next call of `changed` return True for every key."""
        self._last.clear()


def _differ(before: object, now: object) -> bool:
    if before is now:
        return False
    # Without `isinstance`, as numpy is not imported before the first picture.
    is_array = any(getattr(value, "ndim", 0) for value in (before, now))
    return is_array or before != now
