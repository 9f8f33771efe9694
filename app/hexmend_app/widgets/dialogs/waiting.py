"""Wait for a task in a thread while the window stays responsive."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QEventLoop, Qt, QTimer
from PySide6.QtWidgets import QMessageBox, QWidget

from hexmend_app.translation import tr

#: Milliseconds until the dialog is shown, and between two checks.
_DELAY, _PERIOD = 300, 20


def waiting_dialog(parent: QWidget, text: str, over: Callable[[], bool], leave: str) -> QMessageBox:
    """Return a dialog that names a task, and closes when the task is done or Cancel is pressed.

    Parameters
    ----------
    parent : QWidget
    text : str
        Description of the task.
    over : callable
        Returns True once the task is done.
    leave : str
        Text of the button that continues without waiting; "" for no button.
    """
    box = QMessageBox(parent)
    box.setWindowTitle(tr("Please wait"))
    box.setTextFormat(Qt.TextFormat.PlainText)
    box.setText(text)
    box.setStandardButtons(QMessageBox.StandardButton.Cancel)
    box.setDefaultButton(QMessageBox.StandardButton.Cancel)  # so that Enter does not press `leave`
    if leave:
        box.addButton(leave, QMessageBox.ButtonRole.AcceptRole)
    timer = QTimer(box, interval=_PERIOD)
    timer.timeout.connect(lambda: box.accept() if over() else None)
    timer.start()
    return box


def wait_until(parent: QWidget, text: str, over: Callable[[], bool], leave: str = "") -> bool:
    """Wait until a task is done, and show a dialog if it takes more than a moment.

    Parameters
    ----------
    parent : QWidget
        The window, which takes no input meanwhile.
    text, over, leave
        See `waiting_dialog`.

    Returns
    -------
    bool
        True to continue; False if the user has cancelled.
    """
    if not over():
        _wait_a_moment(over)
    if over():
        return True
    dialog = waiting_dialog(parent, text, over, leave)
    answer = dialog.exec()
    dialog.deleteLater()
    return answer != QMessageBox.StandardButton.Cancel


def _wait_a_moment(over: Callable[[], bool]) -> None:
    """Wait for at most `_DELAY` without a dialog, which would only flash; user input is handled afterwards."""
    loop = QEventLoop()
    timer = QTimer(interval=_PERIOD)
    timer.timeout.connect(lambda: loop.quit() if over() else None)
    timer.start()
    QTimer.singleShot(_DELAY, loop.quit)
    loop.exec(QEventLoop.ProcessEventsFlag.ExcludeUserInputEvents)
