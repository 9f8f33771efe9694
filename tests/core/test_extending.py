"""Additions to Hexmend: the examples of docs/development/extending.md as files of its own and as entry points of a distribution."""

import json
import os
import re
from pathlib import Path

import numpy as np
import pytest

import hexmend
from hexmend import Mesh, gallery, io
from hexmend.hooks import hook
from hexmend.mesh.hexahedron import UNIT_CUBE
from tests.core.grids import grid
from tests.examples import ROOT, example
from tests.programs import run_python

EXAMPLE = example("A method")
#: Heading of the example, folder in the core, entry-point group, entry.
EXAMPLES = [
    ("A method", "smoothers/global_", "smoothers", "nonlinear-cg = nonlinear_cg:ConjugateGradients"),
    ("A metric", "quality/metrics", "metrics", "oddy = oddy:ODDY"),
    ("A format", "io/formats", "formats", "plain = plain_text:PLAIN_TEXT"),
    ("A gallery mesh", "gallery", "gallery", "twisted-bar = twisted_bar:TwistedBar"),
    ("A command", "cli/commands", "commands", "volume = volume:command"),
]
PROGRAM = """
import json, sys
from hexmend.cli.main import main
for words in json.loads(sys.argv[1]):
    status = main(words)
sys.exit(status)
"""


def python(paths, program, *words, **options):
    """Run a Python program with folders before the others of the path."""
    return run_python("-c", program, *words, paths=paths, **options)


def commands_in(path):
    """Make a function that runs commands in one process; the status of the last one is that of the process."""
    return lambda *commands: python([path], PROGRAM, json.dumps([[str(word) for word in words] for words in commands]))


def write_distribution(site, entry_points, modules):
    """Write a distribution of modules and the text of its entry points into a folder."""
    info = site / "my_methods-1.0.dist-info"
    info.mkdir(parents=True)
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: my-methods\nVersion: 1.0\n")
    (info / "entry_points.txt").write_text(entry_points)
    for name, text in modules.items():
        (site / f"{name}.py").write_text(text, encoding="utf-8")


@pytest.fixture
def installed(tmp_path):
    """Make a distribution of modules and entries, and return a function that runs commands with it."""

    def install(entries, group="smoothers", **modules):
        write_distribution(tmp_path / "site", f"[hexmend.{group}]\n{entries}\n", modules)
        return commands_in(tmp_path / "site")

    return install


def with_files(site):
    """Link a copy of the core into a folder, with each example in the folder of its kind."""
    core = Path(hexmend.__file__).parent
    for folder, _, names in os.walk(core):
        target = site / "hexmend" / Path(folder).relative_to(core)
        target.mkdir(parents=True)
        for name in names:
            (target / name).symlink_to(Path(folder) / name)
    for title, folder, _, entry in EXAMPLES:
        file = site / "hexmend" / folder / f"{re.search('= (.+):', entry)[1]}.py"
        if title == "A command":
            file = file.with_stem(entry.split(" =")[0])
        file.write_text(example(title), encoding="utf-8")


def with_entry_points(site):
    """Write a distribution of all examples into a folder."""
    groups = [f"[hexmend.{group}]\n{entry}\n" for _, _, group, entry in EXAMPLES]
    modules = {re.search("= (.+):", entry)[1]: example(title) for title, _, _, entry in EXAMPLES}
    write_distribution(site, "\n".join(groups), modules)


@pytest.fixture(
    scope="module",
    params=[pytest.param(with_files, marks=pytest.mark.slow), with_entry_points],
    ids=["files", "entry-points"],
)
def site(request, tmp_path_factory):
    """A folder from which Hexmend is run with all examples."""
    path = tmp_path_factory.mktemp("site")
    request.param(path)
    return path


@pytest.fixture
def extended(site):
    """A function that runs commands of Hexmend with all examples."""
    return commands_in(site)


def methods(done):
    """What `hexmend methods --json`, the first command, printed: by name."""
    assert done.returncode == 0, done.stderr
    every, _ = json.JSONDecoder().raw_decode(done.stdout)
    return {one["name"]: one for one in every}


@pytest.mark.parametrize(("entry", "module"), [
    ("nonlinear-cg = my_module", EXAMPLE),
    ("nonlinear-cg = my_module:ConjugateGradients", EXAMPLE),
    ("nonlinear-cg = my_module:ConjugateGradients", EXAMPLE.replace("@hx.method\n", "")),
], ids=["module", "class", "class-without-decorator"])  # fmt: skip
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


FAULTY = {  # end of the entry, module, message
    "absent": ("", "import nowhere_at_all", "ModuleNotFoundError: No module named 'nowhere_at_all'"),
    "leaving": ("", "raise SystemExit('no licence')", "SystemExit: no licence"),
    "torn": ("", "1 /", "SyntaxError"),
    "missing": (":Missing", "", "AttributeError"),
    "foreign": (":Path", "from pathlib import Path", "TypeError: Path is not a hexmend.Smoother"),
    "twice": ("", EXAMPLE.replace('"nonlinear-cg"', '"mend"'), "ValueError: method 'mend' is registered twice"),
    "unsourced": ("", EXAMPLE.replace('    source = "', '    comes_from = "'), "ConjugateGradients has no source"),
}


def test_each_faulty_entry_is_left_out_with_a_line_and_the_others_are_loaded(installed):
    entries = [f"{name} = module_{name}{end}" for name, (end, _, _) in FAULTY.items()]
    modules = {f"module_{name}": text for name, (_, text, _) in FAULTY.items()}
    done = installed("\n".join([*entries, "sound = sound"]), **modules, sound=EXAMPLE)(["methods", "--json"])
    assert {"mend", "nonlinear-cg"} <= set(methods(done))
    lines = done.stderr.splitlines()
    assert len(lines) == len(FAULTY)
    for name, (_, _, message) in FAULTY.items():
        (line,) = (line for line in lines if line.startswith(f"hexmend: the method {name} of my-methods is left out: "))
        assert message in line


def test_entry_points_are_not_read_for_a_method_of_hexmend(installed, tmp_path):
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


SHEARED = UNIT_CUBE @ [[1, 0, 0], [1, 1, 0], [0, 0, 1]]  # SᵀS has 2 and 1 on its diagonal, 1 next to it, and 1
ODDY = 4 + 1 + 1 + 1 + 1 - (2 + 1 + 1) ** 2 / 3


def test_a_metric_is_one_like_any_other(extended, tmp_path):
    mesh = tmp_path / "mesh.vtu"
    io.write(mesh, Mesh(np.vstack([UNIT_CUBE, SHEARED + 5]), np.arange(16).reshape(2, 8)))
    done = extended(["info", mesh, "--metrics", "--json"])
    assert (done.returncode, done.stderr) == (0, "")
    oddy = json.loads(done.stdout)["metrics"]["oddy"]
    assert np.allclose([oddy["min"], oddy["max"]], [0, ODDY])


def test_a_format_is_one_like_any_other(extended, tmp_path):
    mesh, plain, other, back = (tmp_path / name for name in ("mesh.vtu", "mesh.hexes", "plain.txt", "back.vtu"))
    io.write(mesh, gallery.make("cube", size=64, scramble=0.2))
    smooth = ["--method", "laplacian", "--max-iterations", 0]
    done = extended(["smooth", mesh, "-o", plain, *smooth])
    assert (done.returncode, done.stderr) == (0, "")
    plain.rename(other)  # whatever its suffix
    done = extended(["smooth", other, "-o", back, *smooth])
    assert (done.returncode, done.stderr) == (0, "")
    assert np.array_equal(io.read(back).points, io.read(mesh).points)
    assert np.array_equal(io.read(back).hexes, io.read(mesh).hexes)


def test_a_gallery_mesh_is_one_like_any_other(extended, tmp_path):
    path = tmp_path / "bar.vtu"
    done = extended(["gallery", "twisted-bar", "--size", 500, "--set", "turns=0.5", "-o", path], ["gallery"])
    assert (done.returncode, done.stderr) == (0, "")
    assert "cube: Cube" in done.stdout
    assert "twisted-bar: Twisted bar (Hexmend)" in done.stdout
    mesh = io.read(path)
    assert mesh.n_hexes == 500
    assert mesh.quality("scaled_jacobian").min() > 0.5


def test_a_command_is_one_like_any_other(extended, tmp_path):
    mesh = tmp_path / "cube.vtu"
    io.write(mesh, gallery.make("cube", size=27))
    done = extended(["--help"], ["volume", mesh])
    assert (done.returncode, done.stderr) == (0, "")
    assert "  volume     Print the volume of a mesh." in done.stdout.splitlines()
    assert float(done.stdout.splitlines()[-1]) == pytest.approx(1)
    assert extended(["volume", tmp_path / "none.vtu"]).returncode == 3


def test_all_are_in_their_registries_and_in_the_generated_docs(site):
    program = """
import sys
from hexmend.gallery import GALLERY
from hexmend.io import FORMATS, readable_suffixes
from hexmend.quality import METRICS
from hexmend.smoothers import METHODS
assert ".hexes" in readable_suffixes()
assert {"nonlinear-cg", "oddy", "plain", "twisted-bar"} <= {*METHODS, *METRICS, *FORMATS, *GALLERY}
sys.path.insert(0, "scripts")
import tables, write_reference
print(*tables.methods().splitlines(), *tables.metrics().splitlines(), *tables.formats().splitlines(), sep="\\n")
print(*write_reference.methods(), *write_reference.every_command(), sep="\\n")
"""
    done = python([site], program, cwd=ROOT)
    assert (done.returncode, done.stderr) == (0, "")
    lines = done.stdout.splitlines()
    for begin in ("| `nonlinear-cg` |", "| `oddy` |", "| Plain text |", "## nonlinear-cg", "## volume"):
        assert any(line.startswith(begin) for line in lines), begin


def test_a_malformed_file_of_the_format_is_one_clear_line(extended, tmp_path):
    path = tmp_path / "mesh.hexes"
    path.write_text("hexes 8 1\n0 0 0\n")
    done = extended(["info", path])
    assert done.returncode == 3
    (line,) = done.stderr.splitlines()
    assert line.startswith(f"hexmend: {path.name}: ")
    assert "is not a plain mesh: 1 rows follow its first line" in line


@pytest.mark.parametrize(("group", "words"), [
    ("metrics", ["info", "{mesh}", "--metrics"]),
    ("formats", ["info", "{mesh}.nothing"]),
    ("gallery", ["gallery"]),
])  # fmt: skip
def test_an_object_of_another_class_is_left_out_with_a_line(installed, tmp_path, group, words):
    mesh = tmp_path / "mesh.vtu"
    io.write(mesh, grid(1))
    (tmp_path / "mesh.vtu.nothing").write_text("nothing")
    done = installed("odd = my_module:x", group, my_module="x = 3")([word.format(mesh=mesh) for word in words])
    kind = {"metrics": "metric", "formats": "format", "gallery": "gallery mesh"}[group]
    assert f"the {kind} odd of my-methods is left out: TypeError: 3 is not a hexmend." in done.stderr


# Hooks: functions of higher layers that classes of lower ones call.


@pytest.mark.parametrize(
    "name", ["fixed_sets", "html", "plot", "quality", "region", "summary", "with_rules", "worst_hexes"]
)
def test_each_hook_has_a_provider(name):
    assert callable(hook(name))


def test_a_mesh_measures_itself_before_quality_is_imported():
    program = """
import sys
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.hexahedron import UNIT_CUBE
assert "hexmend.quality" not in sys.modules
mesh = Mesh(UNIT_CUBE, [range(8)])
print(mesh.quality("q")[0], mesh.worst(1)[0])
"""
    done = run_python("-c", program)
    assert (done.stdout, done.stderr) == ("1.0 0\n", "")
