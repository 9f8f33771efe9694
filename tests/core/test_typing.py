"""What type checkers see of the package; `make lint` runs one over it."""

import ast
from importlib.resources import files
from pathlib import Path

import pytest

import hexmend as hx
from hexmend.smoothers import METHODS
from tests.programs import run_python

FACE = Path(hx.__file__)


def names_for_type_checkers():
    """Return the name and the module of each import that the package declares in its stub."""
    imports = [node for node in ast.parse(FACE.with_suffix(".pyi").read_text("utf-8")).body if hasattr(node, "names")]
    return {alias.asname: node.module for node in imports for alias in node.names}


def test_the_package_is_marked_as_typed():
    assert files("hexmend").joinpath("py.typed").is_file()


def test_type_checkers_know_every_public_name_and_every_method():
    own = {smoother.__name__ for smoother in METHODS.values() if smoother.__module__.startswith("hexmend.")}
    known = names_for_type_checkers()
    assert own | set(hx.__all__) == set(known)
    for name, module in known.items():
        home = __import__(module, fromlist=[name])
        assert getattr(home, name) is getattr(hx, name)


SCRIPT = """
import hexmend as hx

mesh = hx.read("part.inp")
result = hx.smooth(mesh, hx.Mend(goal="shape"), max_iterations=50, watch=print)
worst = mesh.quality("q")[mesh.worst(10)].min() + result.after.q_min
inverted: int = mesh.quality().inverted
hx.smoth(mesh)
hx.smooth(mesh, progress=3)
hx.Mend(gaol="shape")
mesh.quality().iverted
"""


@pytest.mark.slow
def test_a_type_checker_finds_the_wrong_names_of_a_script_and_no_others(tmp_path):
    pytest.importorskip("mypy")
    script = tmp_path / "script.py"
    script.write_text(SCRIPT, encoding="utf-8")
    words = ["-m", "mypy", "--strict", "--follow-imports=silent", "--cache-dir", tmp_path / "cache", script]
    done = run_python(*words, cwd=tmp_path, variables={"MYPYPATH": str(FACE.parents[1])})
    errors = [line.split(":")[1] for line in done.stdout.splitlines() if ": error:" in line]
    assert errors == ["8", "9", "10", "11"], done.stdout + done.stderr
