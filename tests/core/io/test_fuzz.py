"""Some spoilt files of every format; `scripts/fuzz_readers.py` reads thousands."""

import subprocess
import sys
from pathlib import Path

import pytest

from hexmend.io.format import FORMATS

SCRIPT = Path(__file__).resolve().parents[3] / "scripts/fuzz_readers.py"


@pytest.mark.parametrize("half", [0, 1])
def test_a_spoilt_file_gives_a_mesh_or_one_clear_error(half):
    names = list(FORMATS)[half::2]
    done = subprocess.run(
        [sys.executable, str(SCRIPT), "--cases", "25", "--seed", "7", *names],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert all(f"{name} " in done.stdout for name in names)
