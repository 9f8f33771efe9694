"""Ctrl-C while VTK draws."""

import os
import signal
import subprocess
import sys

import pytest

from hexmend import gallery, io

#: The program; a signal arrives while VTK calls back into Python.
PROGRAM = """
import os, signal, sys
from hexmend.cli.main import main
from hexmend_app.scene.render.stage import Stage
whole = Stage.__init__
def begin(self, size):
    whole(self, size)
    self.window.AddObserver("StartEvent", lambda *_: os.kill(os.getpid(), int(os.environ["SIGNAL"])))
Stage.__init__ = begin
sys.exit(main(sys.argv[1:]))
"""


@pytest.mark.slow
def test_a_signal_while_a_picture_is_drawn_ends_it_in_order(tmp_path):
    io.write(tmp_path / "mesh.vtu", gallery.make("cube", size=27, scramble=0.3))
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM, "render", tmp_path / "mesh.vtu", "-o", tmp_path / "mesh.png"],
        capture_output=True,
        text=True,
        env=os.environ | {"SIGNAL": str(int(signal.SIGTERM))},
        check=False,
    )
    assert (done.returncode, done.stderr) == (128 + signal.SIGTERM, "hexmend: interrupted\n")
    assert [path.name for path in tmp_path.iterdir()] == ["mesh.vtu"]
