"""Wait for a task in a thread while the window stays responsive."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QEventLoop, Qt, QTimer
from PySide6.QtWidgets import QDialog, QDialogButtonBox, QLabel, QProgressBar, QVBoxLayout, QWidget

from hexmend_app.theme.spacing import fill
from hexmend_app.translation import tr

#: Milliseconds until the dialog is shown, and between two checks.
_DELAY, _PERIOD = 300, 20


class WaitingDialog(QDialog):
    """Dialog that names a task and closes when it is done.

    Parameters
    ----------
    text : str
        Description of the task.
    over : callable
        Returns True once the task is done.
    leave : str
        Text of the button that continues without waiting; "" for no button.
    parent : QWidget
    """

    def __init__(self, text: str, over: Callable[[], bool], leave: str, parent: QWidget):
        super().__init__(parent)
        self.setWindowTitle(tr("Please wait"))
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
        buttons.button(QDialogButtonBox.StandardButton.Cancel).setDefault(True)  # so that Enter does not press `leave`
        fill(QVBoxLayout(self), label, bar, buttons)
        self._over = over
        self._timer = QTimer(self, interval=_PERIOD)
        self._timer.timeout.connect(self._check)
        self._timer.start()

    def _check(self) -> None:
        if self._over():
            self.accept()


def wait_until(parent: QWidget, text: str, over: Callable[[], bool], leave: str = "") -> bool:
    """Wait until a task is done, and show a `WaitingDialog` if it takes more than a moment.

    Parameters
    ----------
    parent : QWidget
        The window, which takes no input meanwhile.
    text, over, leave
        See `WaitingDialog`.

    Returns
    -------
    bool
        True to continue; False if the user has cancelled.
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
    """Wait for at most `_DELAY` without a dialog, which would only flash; user input is handled afterwards."""
    loop = QEventLoop()
    timer = QTimer(interval=_PERIOD)
    timer.timeout.connect(lambda: loop.quit() if over() else None)
    timer.start()
    QTimer.singleShot(_DELAY, loop.quit)
    loop.exec(QEventLoop.ProcessEventsFlag.ExcludeUserInputEvents)
