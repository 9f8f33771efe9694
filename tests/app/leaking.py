"""Tests that leave something behind, for `test_guards.py`, which runs them. The file's name keeps it out of the suite."""

from __future__ import annotations

import tempfile
import threading

import pytest
from PySide6.QtCore import QThread
from PySide6.QtWidgets import QDialog

from tests import guards

#: What is left behind lives until the last test is over.
LEFT = []
OVER = threading.Event()


@pytest.fixture(autouse=True, scope="module")
def over():
    """The guards wait a moment only; and in the end all comes to an end, that the process may."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(guards, "GRACE", 0.2)
        yield
    OVER.set()
    for one in LEFT:
        one.wait() if isinstance(one, QThread) else one.close()


def test_nothing(qtbot, tmp_path):
    thread = threading.Thread(target=lambda: None)
    thread.start()
    with tempfile.NamedTemporaryFile():
        (tmp_path / "kept").touch()
    dialog = QDialog()
    qtbot.addWidget(dialog)
    dialog.show()


def test_a_thread():
    threading.Thread(target=OVER.wait, name="left alone", daemon=True).start()


def test_a_thread_of_qt(qtbot):
    class Working(QThread):
        def run(self):
            threading.current_thread()  # Python hears of it
            begun.set()
            OVER.wait()

    begun = threading.Event()
    LEFT.append(Working())
    LEFT[-1].start()
    begun.wait(10)


def test_a_thread_of_qt_that_ends(qtbot):
    class Working(QThread):
        def run(self):
            threading.current_thread()

    thread = Working()
    thread.start()
    thread.wait()


def test_a_file():
    tempfile.mkstemp()


def test_a_window(qtbot):
    LEFT.append(QDialog())
    LEFT[-1].setWindowTitle("Open still")
    LEFT[-1].show()
