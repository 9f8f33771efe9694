"""Methods of other distributions: the example of docs/extending.md, as one that is installed, and what is wrong with some."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from hexmend import gallery, io

TEXT = (Path(__file__).resolve().parents[2] / "docs/extending.md").read_text(encoding="utf-8")
(EXAMPLE,) = re.findall(r"```python\n(.*?)```", TEXT, re.DOTALL)


@pytest.fixture
def installed(tmp_path):
    """Make a distribution of a module and entries, and return a way to run the program beside it."""
    site = tmp_path / "site"
    info = site / "my_methods-1.0.dist-info"
    info.mkdir(parents=True)
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: my-methods\nVersion: 1.0\n")

    def install(entries, **modules):
        (info / "entry_points.txt").write_text(f"[hexmend.smoothers]\n{entries}\n")
        for name, text in modules.items():
            (site / f"{name}.py").write_text(text, encoding="utf-8")
        path = os.pathsep.join(filter(None, [str(site), os.environ.get("PYTHONPATH", "")]))

        def run(*words):
            return subprocess.run(
                [sys.executable, "-m", "hexmend", *map(str, words)],
                env=os.environ | {"PYTHONPATH": path}, capture_output=True, text=True,
            )  # fmt: skip

        return run

    return install


def methods(run):
    done = run("methods", "--json")
    assert done.returncode == 0, done.stderr
    return {one["name"]: one for one in json.loads(done.stdout)}, done.stderr


@pytest.mark.parametrize(("entry", "module"), [
    ("nonlinear-cg = my_module", EXAMPLE),
    ("nonlinear-cg = my_module:ConjugateGradients", EXAMPLE),
    ("nonlinear-cg = my_module:ConjugateGradients", EXAMPLE.replace("@hx.method\n", "")),
], ids=["module", "class", "class-that-does-not-announce-itself"])  # fmt: skip
def test_the_example_is_a_method_like_any_other(installed, tmp_path, entry, module):
    run = installed(entry, my_module=module)
    every, said = methods(run)
    assert said == ""
    assert "mend" in every
    assert [one["name"] for one in every["nonlinear-cg"]["parameters"]] == ["p", "delta"]
    mesh, out, report = tmp_path / "mesh.vtk", tmp_path / "out.vtk", tmp_path / "report.json"
    io.write(mesh, gallery.make("five-side", size=500, scramble=0.4, seed=2))
    done = run("smooth", mesh, "-o", out, "--method", "nonlinear-cg", "--set", "p=3", "--json", report)
    assert done.returncode == 0, done.stderr
    answer = json.loads(report.read_text())
    assert answer["parameters"] == {"p": 3, "delta": 0.05}
    assert answer["outcome"] == "converged"
    assert answer["before"]["inverted"] > 0 == answer["after"]["inverted"]
    assert answer["after"]["q_mean"] > answer["before"]["q_mean"]


def test_the_example_is_short_and_uses_numpy_and_the_face_alone():
    assert len(EXAMPLE.splitlines()) < 50
    names = set(re.findall(r"^(?:import|from) ([\w.]+)", EXAMPLE, re.MULTILINE))
    assert names == {"dataclasses", "numpy", "hexmend"}


@pytest.mark.parametrize(("entry", "module", "message"), [
    ("odd = my_module", "import nowhere_at_all", "ModuleNotFoundError: No module named 'nowhere_at_all'"),
    ("odd = my_module", "raise SystemExit('no licence')", "SystemExit: no licence"),
    ("odd = my_module", "1 /", "SyntaxError"),
    ("odd = my_module:Missing", "", "AttributeError"),
    ("odd = my_module:Path", "from pathlib import Path", "TypeError: Path is no hexmend.Smoother"),
    ("odd = my_module", EXAMPLE.replace('"nonlinear-cg"', '"mend"'), "ValueError: method 'mend' is registered twice"),
    ("odd = my_module", EXAMPLE.replace('    source = "', '    comes_from = "'), "ConjugateGradients has no source"),
])  # fmt: skip
def test_what_is_wrong_with_one_is_said_in_a_line_and_the_others_go_on(installed, entry, module, message):
    run = installed(f"{entry}\nsound = sound", my_module=module, sound=EXAMPLE)
    every, said = methods(run)
    assert {"mend", "nonlinear-cg"} <= set(every)
    assert len(said.splitlines()) == 1
    assert said.startswith("hexmend: the method odd of my-methods is left out: ")
    assert message in said


def test_who_names_a_method_of_hexmend_does_not_wait_for_others(installed, tmp_path):
    run = installed("odd = my_module", my_module="1 / 0")
    mesh = tmp_path / "mesh.vtk"
    io.write(mesh, gallery.make("cube", size=27, scramble=0.2))
    for words in (["info", mesh], ["smooth", mesh, "-o", tmp_path / "out.vtk", "--method", "laplacian"]):
        done = run(*words)
        assert (done.returncode, done.stderr) == (0, "")
    done = run("smooth", mesh, "-o", tmp_path / "out.vtk", "--method", "laplacien")
    assert done.returncode == 2
    assert "did you mean laplacian?" in done.stderr
    assert "odd of my-methods" in done.stderr
