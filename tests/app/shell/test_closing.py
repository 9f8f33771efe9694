"""Closing the window ends the program, even while threads are running."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

PROGRAM = """
import sys
from PySide6.QtCore import QSettings, QTimer
for form in (QSettings.Format.NativeFormat, QSettings.Format.IniFormat):
    QSettings.setPath(form, QSettings.Scope.UserScope, sys.argv[2])
from hexmend_app.shell.start.program import application, open_window
from hexmend_app.shell.window import Window

def close():
    for window in application().topLevelWidgets():
        if isinstance(window, Window) and window.session is not None and window.session.opener.busy:
            timer.stop()
            {before}
            window.close()

application()
timer = QTimer(interval=100)
timer.timeout.connect(close)
timer.start()
sys.exit(open_window(sys.argv[1]))
"""


@pytest.mark.slow
@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no named pipes")
@pytest.mark.parametrize("before", ["pass", "window.session.opener.cancel()"], ids=["while it reads", "after Cancel"])
def test_the_process_ends_with_its_window_although_a_file_does_not_respond(qapp, tmp_path, before):
    os.mkfifo(tmp_path / "dead.vtk")
    program = PROGRAM.replace("{before}", before)
    words = [sys.executable, "-c", program, str(tmp_path / "dead.vtk"), str(tmp_path / "settings")]
    ended = subprocess.run(words, capture_output=True, text=True, timeout=100)
    assert ended.returncode == 0, ended.stderr
    assert "closed while threads were running: reading dead.vtk" in ended.stderr
