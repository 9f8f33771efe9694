"""Interface of the window for features."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Protocol

from PySide6.QtGui import QAction
from PySide6.QtWidgets import QWidget

if TYPE_CHECKING:
    from hexmend_app.canvas.canvas import Canvas
    from hexmend_app.state.session.session import Session
    from hexmend_app.widgets.busy import Busy
    from hexmend_app.widgets.message_bar import MessageBar


class Host(Protocol):
    """Part of the window that features use.

    Attributes
    ----------
    session : Session
        State of the window.
    canvas : Canvas or None
        The 3D view; None until it is built.
    messages : MessageBar
        Shows errors and results.
    busy : Busy
        Shows tasks in progress, with a button to cancel.
    """

    session: Session
    canvas: Canvas | None
    messages: MessageBar
    busy: Busy

    @property
    def dialog_parent(self) -> QWidget:
        """Parent of dialogs: the window."""

    def action(self, id: str) -> QAction:
        """Return the action of any feature; available once all features are built."""

    def show_panel(self, id: str) -> None:
        """Open a panel in front of its tabs."""

    def offer_panel(self, id: str) -> None:
        """Put an open panel in front of its tabs; the drawer and hidden panels stay closed."""

    def in_front(self, id: str) -> bool:
        """Return True if a panel is visible."""

    def may_leave(self) -> bool:
        """Return True if no feature objects to closing the mesh."""

    def wait_until(self, text: str, over: Callable[[], bool], leave: str = "") -> bool:
        """Wait until `over()` is true.

        Return True when it is over or the user pressed `leave`; False if the user cancelled.
        """

    def refresh_soon(self) -> None:
        """Request a refresh of everything, once, in the next turn of the event loop."""

    @property
    def stem(self) -> str:
        """Default name of files to save, without suffix."""

    def try_and_report(self, failure: str, act: Callable[[], object], success: str = "") -> bool:
        """Call `act` and show `success`, or an error with the title `failure`; return True if it succeeded."""
