"""Guards against leaks fail a test that leaves a thread, a file or a window."""

from __future__ import annotations

import threading

import pytest

from tests import guards
from tests.guards import temporary_files_go, threads_end, windows_close


def test_a_thread_that_is_left_running_is_an_error(monkeypatch):
    monkeypatch.setattr(guards, "GRACE", 0.05)
    over = threading.Event()
    with pytest.raises(pytest.fail.Exception, match="left alone"), threads_end():
        thread = threading.Thread(target=over.wait, name="left alone")
        thread.start()
    over.set()
    thread.join()


def test_a_file_that_is_left_is_an_error(tmp_path):
    with (
        pytest.raises(pytest.fail.Exception, match=r"temporary files are left: left\.txt"),
        temporary_files_go(tmp_path),
    ):
        (tmp_path / "left.txt").touch()
    assert not list(tmp_path.iterdir())


def test_a_window_that_is_left_open_is_an_error(qtbot):
    from PySide6.QtWidgets import QDialog

    with pytest.raises(pytest.fail.Exception, match="'Open still'"), windows_close():
        dialog = QDialog()
        dialog.setWindowTitle("Open still")
        dialog.show()
    qtbot.addWidget(dialog)
