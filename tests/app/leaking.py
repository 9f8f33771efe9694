"""Tests that leak threads, files and windows, run by `test_guards.py`; the file name excludes them from the suite."""

from __future__ import annotations

import tempfile
import threading

import pytest
from PySide6.QtCore import QThread
from PySide6.QtWidgets import QDialog

from tests import guards
from tests.patience import PATIENCE

#: Leaked objects, which live until the last test has ended.
LEFT = []
OVER = threading.Event()


@pytest.fixture(autouse=True, scope="module")
def over():
    """Shorten the wait of the guards; at the end, close all leaked objects so that the process can end."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(guards, "GRACE", 1.0)
        yield
    OVER.set()
    for leaked in LEFT:
        leaked.wait() if isinstance(leaked, QThread) else leaked.close()


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
            threading.current_thread()  # registers the thread with Python
            begun.set()
            OVER.wait()

    begun = threading.Event()
    LEFT.append(Working())
    LEFT[-1].start()
    assert begun.wait(PATIENCE / 1000)


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
