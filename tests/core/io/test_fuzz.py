"""Some spoilt files of every format; `scripts/fuzz_readers.py` reads thousands, and larger ones."""

from pathlib import Path

import pytest

from hexmend.io.base.format import FORMATS
from tests.programs import run_python

pytestmark = pytest.mark.slow

SCRIPT = Path(__file__).resolve().parents[3] / "scripts/fuzz_readers.py"

#: Formats of which each file is read in a process of its own, which takes its time.
APART = ["med", "vtkhdf"]


@pytest.mark.parametrize(("names", "cases"), [
    ([*(name for name in FORMATS if name not in APART), "session"], 50), (APART, 4),
], ids=["here", "apart"])  # fmt: skip
def test_a_spoilt_file_gives_a_mesh_or_one_clear_error(names, cases):
    words = ["--cases", str(cases), "--seed", "7", "--meshes", str(Path(__file__).with_name("files")), *names]
    done = run_python(SCRIPT, *words)
    assert done.returncode == 0, done.stderr
    assert all(f"{name} " in done.stdout for name in names)
