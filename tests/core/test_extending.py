"""What other distributions add: the examples of docs/extending.md, as installed ones, and what is wrong with some."""

import json
import os
import re
import subprocess
import sys

import numpy as np
import pytest

from hexmend import gallery, io
from hexmend.mesh.hexahedron import UNIT_CUBE
from hexmend.mesh.mesh import Mesh
from tests.core.grids import grid
from tests.examples import example

EXAMPLE = example("A method")
PROGRAM = """
import json, sys
from hexmend.cli.main import main
for words in json.loads(sys.argv[1]):
    status = main(words)
sys.exit(status)
"""


@pytest.fixture
def installed(tmp_path):
    """Make a distribution of a module and entries, and return a way to run the program beside it."""
    site = tmp_path / "site"
    info = site / "my_methods-1.0.dist-info"
    info.mkdir(parents=True)
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: my-methods\nVersion: 1.0\n")

    def install(entries, group="smoothers", **modules):
        (info / "entry_points.txt").write_text(f"[hexmend.{group}]\n{entries}\n")
        for name, text in modules.items():
            (site / f"{name}.py").write_text(text, encoding="utf-8")
        path = os.pathsep.join(filter(None, [str(site), os.environ.get("PYTHONPATH", "")]))

        def run(*commands):
            """Run commands in one process; the last one's status is the process's."""
            return subprocess.run(
                [sys.executable, "-c", PROGRAM, json.dumps([[str(word) for word in words] for words in commands])],
                env=os.environ | {"PYTHONPATH": path}, capture_output=True, text=True,
            )  # fmt: skip

        return run

    return install


def methods(done):
    """What `hexmend methods --json`, the first command, printed: by name."""
    assert done.returncode == 0, done.stderr
    every, _ = json.JSONDecoder().raw_decode(done.stdout)
    return {one["name"]: one for one in every}


@pytest.mark.parametrize(("entry", "module"), [
    ("nonlinear-cg = my_module", EXAMPLE),
    ("nonlinear-cg = my_module:ConjugateGradients", EXAMPLE),
    ("nonlinear-cg = my_module:ConjugateGradients", EXAMPLE.replace("@hx.method\n", "")),
], ids=["module", "class", "class-that-does-not-announce-itself"])  # fmt: skip
def test_the_example_is_a_method_like_any_other(installed, tmp_path, entry, module):
    run = installed(entry, my_module=module)
    mesh, out, report = tmp_path / "mesh.vtk", tmp_path / "out.vtk", tmp_path / "report.json"
    io.write(mesh, gallery.make("five-side", size=500, scramble=0.4, seed=2))
    done = run(
        ["methods", "--json"],
        ["smooth", mesh, "-o", out, "--method", "nonlinear-cg", "--set", "p=3", "--json", report],
    )
    every = methods(done)
    assert done.stderr == ""
    assert "mend" in every
    assert [one["name"] for one in every["nonlinear-cg"]["parameters"]] == ["p", "delta"]
    answer = json.loads(report.read_text())
    assert answer["parameters"] == {"p": 3, "delta": 0.05}
    assert answer["outcome"] == "converged"
    assert answer["before"]["inverted"] > 0 == answer["after"]["inverted"]
    assert answer["after"]["q_mean"] > answer["before"]["q_mean"]


def test_the_example_is_short_and_uses_numpy_and_the_face_alone():
    assert len(EXAMPLE.splitlines()) < 50
    names = set(re.findall(r"^(?:import|from) ([\w.]+)", EXAMPLE, re.MULTILINE))
    assert names == {"dataclasses", "numpy", "hexmend"}


WRONG = {  # entry, module, and what is said of them
    "absent": ("", "import nowhere_at_all", "ModuleNotFoundError: No module named 'nowhere_at_all'"),
    "leaving": ("", "raise SystemExit('no licence')", "SystemExit: no licence"),
    "torn": ("", "1 /", "SyntaxError"),
    "missing": (":Missing", "", "AttributeError"),
    "foreign": (":Path", "from pathlib import Path", "TypeError: Path is no hexmend.Smoother"),
    "twice": ("", EXAMPLE.replace('"nonlinear-cg"', '"mend"'), "ValueError: method 'mend' is registered twice"),
    "unsourced": ("", EXAMPLE.replace('    source = "', '    comes_from = "'), "ConjugateGradients has no source"),
}


def test_what_is_wrong_with_some_is_said_in_a_line_each_and_the_others_go_on(installed):
    entries = [f"{name} = module_{name}{what}" for name, (what, _, _) in WRONG.items()]
    modules = {f"module_{name}": text for name, (_, text, _) in WRONG.items()}
    done = installed("\n".join([*entries, "sound = sound"]), **modules, sound=EXAMPLE)(["methods", "--json"])
    assert {"mend", "nonlinear-cg"} <= set(methods(done))
    said = done.stderr.splitlines()
    assert len(said) == len(WRONG)
    for name, (_, _, message) in WRONG.items():
        (line,) = (line for line in said if line.startswith(f"hexmend: the method {name} of my-methods is left out: "))
        assert message in line


def test_who_names_a_method_of_hexmend_does_not_wait_for_others(installed, tmp_path):
    run = installed("odd = my_module", my_module="1 / 0")
    mesh = tmp_path / "mesh.vtk"
    io.write(mesh, gallery.make("cube", size=27, scramble=0.2))
    smooth = ["smooth", mesh, "-o", tmp_path / "out.vtk", "--method"]
    done = run(["info", mesh], [*smooth, "laplacian"])
    assert (done.returncode, done.stderr) == (0, "")
    done = run([*smooth, "laplacien"])
    assert done.returncode == 2
    assert "did you mean laplacian?" in done.stderr
    assert "odd of my-methods" in done.stderr


SHEARED = UNIT_CUBE @ [[1, 0, 0], [1, 1, 0], [0, 0, 1]]  # SᵀS has 2 and 1 on its diagonal, 1 beside it, and 1
ODDY = 4 + 1 + 1 + 1 + 1 - (2 + 1 + 1) ** 2 / 3


def test_a_metric_is_one_like_any_other(installed, tmp_path):
    mesh = tmp_path / "mesh.vtu"
    io.write(mesh, Mesh(np.vstack([UNIT_CUBE, SHEARED + 5]), np.arange(16).reshape(2, 8)))
    run = installed("oddy = my_metric:ODDY", "metrics", my_metric=example("A metric"))
    done = run(["info", mesh, "--metrics", "--json"])
    assert (done.returncode, done.stderr) == (0, "")
    oddy = json.loads(done.stdout)["metrics"]["oddy"]
    assert np.allclose([oddy["min"], oddy["max"]], [0, ODDY])


def test_a_format_is_one_like_any_other(installed, tmp_path):
    mesh, plain, other, back = (tmp_path / name for name in ("mesh.vtu", "mesh.hexes", "plain.txt", "back.vtu"))
    io.write(mesh, gallery.make("cube", size=64, scramble=0.2))
    run = installed("plain = my_format:PLAIN", "formats", my_format=example("A format"))
    smooth = ["--method", "laplacian", "--max-iterations", 0]
    done = run(["smooth", mesh, "-o", plain, *smooth])
    assert (done.returncode, done.stderr) == (0, "")
    plain.rename(other)  # whatever its suffix
    done = run(["smooth", other, "-o", back, *smooth])
    assert (done.returncode, done.stderr) == (0, "")
    assert np.array_equal(io.read(back).points, io.read(mesh).points)
    assert np.array_equal(io.read(back).hexes, io.read(mesh).hexes)


@pytest.mark.parametrize(("text", "complaint"), [
    ("hexes 8 1\n0 0 0\n", "is no plain mesh: 1 rows stand below its first line"),
    ("hexes 1 1\n0 0 0\n0 0 0 0 0 0 0 9\n", "numbers from 0 to 0"),
    ("hexes 8\n", "is no plain mesh"),
])  # fmt: skip
def test_a_spoilt_file_of_the_format_is_one_clear_line(installed, tmp_path, text, complaint):
    path = tmp_path / "mesh.hexes"
    path.write_text(text)
    done = installed("plain = my_format:PLAIN", "formats", my_format=example("A format"))(["info", path])
    assert done.returncode == 3
    (line,) = done.stderr.splitlines()
    assert line.startswith(f"hexmend: {path.name}: ")
    assert complaint in line


@pytest.mark.parametrize(("group", "words"), [
    ("metrics", ["info", "{mesh}", "--metrics"]),
    ("formats", ["info", "{mesh}.nothing"]),
])  # fmt: skip
def test_what_is_no_metric_or_format_is_left_out_in_a_line(installed, tmp_path, group, words):
    mesh = tmp_path / "mesh.vtu"
    io.write(mesh, grid(1))
    (tmp_path / "mesh.vtu.nothing").write_text("nothing")
    done = installed("odd = my_module:x", group, my_module="x = 3")([word.format(mesh=mesh) for word in words])
    assert f"the {group[:-1]} odd of my-methods is left out: TypeError: 3 is no hexmend." in done.stderr
