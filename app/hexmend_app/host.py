"""Interface of the window for features."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Protocol

from PySide6.QtCore import QObject
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QWidget

from hexmend.errors import HexmendError
from hexmend_app.translation import tr

if TYPE_CHECKING:
    from hexmend_app.canvas.canvas import Canvas
    from hexmend_app.state.session.session import Session
    from hexmend_app.state.tasks.mesh_change import MeshChanger
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

    def raise_if_open(self, id: str) -> None:
        """Put an open panel in front of its tabs; closed and hidden panels stay closed."""

    def is_visible(self, id: str) -> bool:
        """Return True if a panel is visible."""

    def confirm_close(self) -> bool:
        """Return True if no feature objects to closing the mesh."""

    def wait_until(self, text: str, over: Callable[[], bool], leave: str = "") -> bool:
        """Wait until `over()` is true.

        Return True when it is over or the user pressed `leave`; False if the user cancelled.
        """

    def refresh_soon(self) -> None:
        """Request a refresh of everything, once, in the next turn of the event loop."""

    @property
    def default_file_stem(self) -> str:
        """Default name of files to save, without suffix."""


class ChangeReport(QObject):
    """Shows that a change is in progress, with a button to cancel it, and that it failed or was cancelled.

    Parameters
    ----------
    host : Host
    change : MeshChanger
    key : str
        Identifies the work in `Host.busy`.
    working, cancel_help, failed, cancelled : str
        Sentence while the change is in progress, help of its button, title if it failed, and sentence if cancelled.
    """

    def __init__(
        self, host: Host, change: MeshChanger, *, key: str, working: str, cancel_help: str, failed: str,
        cancelled: str,
    ):  # fmt: skip
        super().__init__(change)
        self._host, self._change, self._key = host, change, key
        self._working, self._cancel_help, self._failed = working, cancel_help, failed
        change.began.connect(self._on_began)
        change.ended.connect(self._on_over)
        change.failed.connect(self._on_failed)
        change.cancelled.connect(self._on_over)
        change.cancelled.connect(lambda: host.messages.show_info(cancelled))

    def _on_began(self) -> None:
        self._host.busy.show_work(self._key, self._working, tr("Cancel"), self._cancel_help, self._change.cancel)
        self._host.refresh_soon()

    def _on_over(self) -> None:
        self._host.busy.done(self._key)
        self._host.refresh_soon()

    def _on_failed(self, error: Exception) -> None:
        self._on_over()
        if not isinstance(error, HexmendError):
            raise error
        self._host.messages.show_error(self._failed, str(error))
