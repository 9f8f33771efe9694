"""Guards against leaks: run tests that leak, and check that each one fails."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow

MESSAGES = {
    "test_a_thread": "threads are left running: left alone",
    "test_a_thread_of_qt": "threads are left running: Dummy-",
    "test_a_file": "temporary files are left: tmp",
    "test_a_window": "windows are left open: QDialog 'Open still'",
}


def test_leaking_tests_fail(qapp, tmp_path):
    options = ["--no-xvfb", "-p", "no:cacheprovider", "--basetemp", tmp_path / "leaking", "-rE"]
    done = subprocess.run(
        [sys.executable, "-m", "pytest", *options, "tests/app/leaking.py"],
        cwd=Path(__file__).resolve().parents[2], env=os.environ | {"COLUMNS": "200"},
        capture_output=True, text=True, timeout=200,
    )  # fmt: skip
    errors = dict(re.findall(r"^ERROR \S+::(\w+) - (.*)$", done.stdout, re.MULTILINE))
    assert errors.keys() == MESSAGES.keys(), done.stdout
    for name, message in MESSAGES.items():
        assert message in errors[name]
    assert "6 passed, 4 errors" in done.stdout
