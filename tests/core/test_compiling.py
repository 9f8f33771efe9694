"""Whoever waits for a kernel to be compiled is told so."""

import os
import subprocess
import sys

from hexmend import compiling

PROGRAM = """
import numpy as np
from hexmend.numba_kernels.incidence import grouped
from hexmend.compiling import listeners
listeners.append(lambda: print("compiling"))
grouped(np.zeros(3, np.int32), 1)
"""


def test_listeners_hear_of_the_first_kernel_alone(monkeypatch):
    heard = []
    monkeypatch.setattr(compiling, "listeners", [lambda: heard.append(1)])
    monkeypatch.setattr(compiling, "begun", 0)
    compiling.tell()
    compiling.tell()
    assert heard == [1]


def test_a_kernel_that_is_found_on_disk_is_not_spoken_of(tmp_path):
    environment = {key: value for key, value in os.environ.items() if key != "NUMBA_CACHE_DIR"}
    environment["XDG_CACHE_HOME"] = str(tmp_path)

    def said():
        done = subprocess.run(
            [sys.executable, "-c", PROGRAM], env=environment, capture_output=True, text=True, check=False
        )
        assert done.returncode == 0, done.stderr
        return done.stdout

    assert said() == "compiling\n"
    assert said() == ""
