"""The check of words in make lint finds a word that is out, in Python and in C++, and nothing else."""

import pytest

from tests.examples import ROOT
from tests.programs import run_python

PYTHON = '''def put_back(points): pass
class Bedroom: off_diagonal = {"told": 1}
self.wayTo = off = 1
def f(*, way): """What an iterate is kept for."""
x = f"{n} hexes are told to move"
'''
CPP = """double put_back(int way);
// What a node is.
// Where corners are one node, the first counts: a clause goes on.
throw std::invalid_argument("hexes are told to move");
int x = index("told");  // way
"""


@pytest.mark.parametrize(("suffix", "source", "lines"), [("py", PYTHON, "133445"), ("cpp", CPP, "1124")])
def test_words_that_are_out_are_found(tmp_path, suffix, source, lines):
    path = tmp_path / f"sample.{suffix}"
    path.write_text(source)
    run = run_python(ROOT / "scripts/check_words.py", path)
    assert run.returncode == 1
    assert "".join(sorted(line.removeprefix(f"{path}:")[0] for line in run.stderr.splitlines())) == lines
