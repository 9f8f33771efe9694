"""Waiting for work in a thread while the window stays responsive."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QEventLoop, Qt, QTimer
from PySide6.QtWidgets import QDialog, QDialogButtonBox, QLabel, QProgressBar, QVBoxLayout, QWidget

#: Milliseconds until the dialog is shown, and between two checks.
_PATIENCE, _PERIOD = 300, 20


class WaitingDialog(QDialog):
    """Shows the work that is waited for, and closes when it is done.

    Parameters
    ----------
    text : str
        What is going on.
    over : callable
        Whether it is over.
    leave : str
        On the button that goes on without waiting; "" for no such button.
    parent : QWidget
    """

    def __init__(self, text: str, over: Callable[[], bool], leave: str, parent: QWidget):
        super().__init__(parent)
        self.setWindowTitle("Please wait")
        self.setWindowModality(Qt.WindowModality.ApplicationModal)
        label = QLabel(text)
        label.setTextFormat(Qt.TextFormat.PlainText)
        label.setWordWrap(True)
        bar = QProgressBar()
        bar.setRange(0, 0)
        bar.setTextVisible(False)
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Cancel)
        buttons.rejected.connect(self.reject)
        if leave:
            buttons.addButton(leave, QDialogButtonBox.ButtonRole.AcceptRole)
            buttons.accepted.connect(self.accept)
        buttons.button(QDialogButtonBox.StandardButton.Cancel).setDefault(True)  # Enter cancels nothing
        layout = QVBoxLayout(self)
        for part in (label, bar, buttons):
            layout.addWidget(part)
        self._over = over
        self._look = QTimer(self, interval=_PERIOD)
        self._look.timeout.connect(self._on_look)
        self._look.start()

    def _on_look(self) -> None:
        if self._over():
            self.accept()


def wait_until(parent: QWidget, text: str, over: Callable[[], bool], leave: str = "") -> bool:
    """Wait until work is done, with a dialog if it takes more than a moment.

    Parameters
    ----------
    parent : QWidget
        The window; nothing can be done in it meanwhile.
    text : str
        What is going on.
    over : callable
        Whether it is over.
    leave : str
        On a button that goes on without waiting; "" for no such button.

    Returns
    -------
    bool
        Whether to go on: False where the user has cancelled what was to come next.
    """
    if not over():
        _wait_a_moment(over)
    if over():
        return True
    dialog = WaitingDialog(text, over, leave, parent)
    answer = dialog.exec()
    dialog.deleteLater()
    return answer == QDialog.DialogCode.Accepted


def _wait_a_moment(over: Callable[[], bool]) -> None:
    """Wait without a dialog, which would only flash; user input is handled afterwards."""
    loop = QEventLoop()
    look = QTimer(interval=_PERIOD)
    look.timeout.connect(lambda: loop.quit() if over() else None)
    look.start()
    QTimer.singleShot(_PATIENCE, loop.quit)
    loop.exec(QEventLoop.ProcessEventsFlag.ExcludeUserInputEvents)
