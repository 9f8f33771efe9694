"""The commands that `smooth` prints as advice can be run as they are, and help."""

import json
import shlex
from shlex import quote

import numpy as np
import pytest

from hexmend import (
    METHODS,
    Mesh,
    MotionRules,
    Recipe,
    StoppingCriteria,
    gallery,
    io,
    measure,
    summarise,
    write,
    write_recipe,
)
from hexmend.advice import Suggestion
from hexmend.cli.commands.smooth.suggested_command import RunOptions, suggested_command
from hexmend.cli.main import main
from hexmend.solver_checks import QUOTED, SOLVERS
from tests.core.boundary.solids import ball, slid
from tests.core.doctor.faulty_meshes import bent
from tests.core.grids import displaced, grid, invalid_inside


def folded(n: int = 5):
    """A grid with the nodes of an inner square folded over; sets name them, their hexes, and what lies around."""
    mesh = grid(n)
    middle = np.flatnonzero((np.abs(mesh.points - n / 2) < 0.6).all(axis=1))
    far = np.flatnonzero((mesh.points == 1).all(axis=1))
    around = np.flatnonzero(np.isin(mesh.hexes, middle).any(axis=1))
    sets = {"middle": middle, "far": far, "-odd name": far}
    return displaced(mesh, middle[:4], [0, 0, 1.4]).replace(node_sets=sets, hex_sets={"some": around[:1]})


RUNS = {
    "a set is fixed": (folded, ["--fix", "middle", "--fix", "far"]),
    "a set with a hyphen is kept": (folded, ["--fix", "middle", "--fix=-odd name"]),
    "a part is too small": (folded, ["--only", "some", "--rings", "0", "--as-is"]),
    "a part within one layer": (
        lambda: gallery.make("five-side", size=100, scramble=1.5).replace(hex_sets={"some": np.arange(20)}),
        ["--only", "some", "--rings=0"],
    ),
    "a part and a set": (folded, ["--only", "some", "--fix", "middle"]),
    "a heuristic with a sliding boundary": (
        lambda: gallery.make("bridge-sharp", size=250, scramble=1.0),
        ["--method", "laplacian", "--boundary", "slide", "--max-iterations", "2", "--keep-last"],
    ),
    "cut short": (lambda: gallery.make("five-side", size=300, scramble=1.5), ["--max-iterations", "2", "--target", "0.1 + x*x"]),
    "a boundary that is folded": (lambda: slid(ball(3), 0.6, seed=0), []),
    "no delta": (lambda: gallery.make("five-side", size=300, scramble=1.5), ["--method", "global-sd", "--set", "delta=0"]),
    "worse than before": (
        lambda: gallery.make("bridge-sharp", size=864),
        ["--method", "laplacian", "--keep-last", "--max-iterations", "20"],
    ),
}  # fmt: skip


QUICK = ("a set with a hyphen is kept", "cut short")


def advised(words, capsys):
    """Run a command; return its code and the commands that it advises, as words."""
    capsys.readouterr()
    code = main(words)
    said = capsys.readouterr().out.splitlines()
    return code, [shlex.split(line) for line in said if line.startswith("      hexmend ")], "\n".join(said)


@pytest.mark.parametrize(
    "name", [name if name in QUICK else pytest.param(name, marks=pytest.mark.slow) for name in RUNS]
)
def test_every_command_that_is_advised_runs_and_helps(name, tmp_path, capsys):
    make_mesh, options = RUNS[name]
    path, out = str(tmp_path / "a mesh.vtu"), str(tmp_path / "out.vtu")
    io.write(path, make_mesh())
    code, commands, said = advised(["smooth", path, "-o", out, *options], capsys)
    assert code == 4, said
    assert commands, said
    left = summarise(io.read(out, as_is=True)).inverted
    for at, words in enumerate(commands):
        following = str(tmp_path / f"after{at}.vtu")
        assert words[:2] == ["hexmend", "smooth"]
        assert main([following if word == "OUT" else word for word in words[1:]]) in (0, 4), words
        assert summarise(io.read(following, as_is=True)).inverted < left, words


def test_fixed_sets_that_hold_hexes_are_named_and_others_stay(tmp_path, capsys):
    path, out = str(tmp_path / "mesh.vtu"), str(tmp_path / "out.vtu")
    io.write(path, folded())
    _, commands, said = advised(["smooth", path, "-o", out, "--fix", "middle", "--fix", "far"], capsys)
    assert "Run Mend without the rule that fixes the nodes of 'middle' (fix): it keeps hexes inverted." in said
    assert commands == [["hexmend", "smooth", out, "-o", "OUT", "--fix", "far"]]
    assert "slid" not in said.partition("Written")[2]


def test_rules_of_a_recipe_are_kept_as_options(tmp_path, capsys):
    path, out, recipe = (str(tmp_path / name) for name in ("mesh.vtu", "out.vtu", "a.toml"))
    io.write(path, folded())
    write_recipe(recipe, Recipe.of("mend", rules=MotionRules("slide", fix=("middle", "far"))))
    _, commands, _ = advised(["smooth", path, "-o", out, "--recipe", recipe], capsys)
    assert commands == [["hexmend", "smooth", out, "-o", "OUT", "--interfaces", "slide", "--fix", "far"]]


def test_a_part_is_kept_or_made_larger(tmp_path, capsys):
    path, out = str(tmp_path / "mesh.vtu"), str(tmp_path / "out.vtu")
    io.write(path, folded())
    _, commands, said = advised(["smooth", path, "-o", out, "--only", "some", "--rings", "0"], capsys)
    assert "outside of this one" in said
    assert "pin" not in said.partition("Written")[2]
    assert commands == [["hexmend", "smooth", out, "-o", "OUT", "--only", "some", "--rings", "2"]]


RINGS = [
    (["--rings", "2"], "--rings 2 is for a part of the mesh: name it with --only, or leave it out"),
    (["--only", "some", "--rings", "-1"], "--rings -1 is out of bounds: expected a number of at least 0"),
]


@pytest.mark.parametrize(("words", "said"), RINGS)
def test_rings_are_of_a_part_of_the_mesh(words, said, tmp_path, run_command):
    path, out = tmp_path / "mesh.vtu", tmp_path / "out.vtu"
    io.write(path, folded())
    assert said in run_command("smooth", path, "-o", out, *words, status=2).err
    assert not out.exists()


def test_a_hex_that_is_invalid_between_positive_corners_gets_advice_that_makes_it_valid(tmp_path, capsys):
    path, out, following = (str(tmp_path / name) for name in ("mesh.vtu", "out.vtu", "after.vtu"))
    io.write(path, invalid_inside())
    words = ["--method", "global-mnr", "--max-iterations", "1", "--keep-last"]
    code, commands, said = advised(["smooth", path, "-o", out, *words], capsys)
    assert code == 4
    assert "No hex is inverted, but 1 hex is invalid inside" in said
    assert main([following if word == "OUT" else word for word in commands[0][1:]]) == 0
    assert summarise(io.read(following)).invalid == 0


# The command that stands below a suggestion.


def test_a_command_says_what_a_suggestion_says():
    def command(*args, **more):
        return suggested_command(Suggestion("", "", "inverted", *args, **more), "a b.vtk", "out.vtk")

    assert command(METHODS["mend"](boundary="slide")) == "hexmend smooth out.vtk -o OUT --boundary slide"
    assert command(METHODS["getme"](), undo=True) == "hexmend smooth 'a b.vtk' -o OUT --method getme"
    assert command(METHODS["mend"](), StoppingCriteria(max_iterations=7, keep_last=True)).endswith(
        " OUT --max-iterations 7 --keep-last"
    )
    assert command(METHODS["mend"](), unpin=np.array([3])) == ""


def test_a_command_keeps_the_options_of_the_run():
    def command(smoother, **more):
        options = RunOptions(MotionRules(fix="a"), as_is=True, surface="skin.stl", only="part", rings=3)
        return suggested_command(Suggestion("", "", "inverted", smoother, **more), "a.vtk", "out.vtk", options)

    slides = command(METHODS["mend"](boundary="slide"))
    assert slides.endswith(" --as-is --boundary slide --surface skin.stl --only part --rings 3 --fix a")
    assert command(METHODS["mend"]()) == "hexmend smooth out.vtk -o OUT --as-is --only part --rings 3 --fix a"
    assert command(METHODS["mend"](), widen=True).endswith("--rings 8 --fix a")
    assert command(METHODS["mend"](), rules=MotionRules()).endswith("--rings 3")
    assert command(METHODS["mend"](target="-x + 2")).partition("--as-is ")[2].startswith("'--target=-x + 2' ")


# Judgement and next command at the end of `hexmend info`.


def ended(path, mesh, capsys, *words):
    """Write the mesh; return the last line of the report, and the record."""
    io.write(path, mesh)
    assert main(["info", str(path), *words]) == 0
    line = capsys.readouterr().out.splitlines()[-1]
    assert main(["info", str(path), "--json", *words]) == 0
    record = json.loads(capsys.readouterr().out)
    assert line == " Next: ".join(filter(None, [record["judgement"], record["next"]]))
    return line, record


def test_a_good_mesh_is_fit(tmp_path, capsys):
    path = tmp_path / "cube.vtu"
    line, record = ended(path, gallery.make("cube", size=8), capsys)
    fit = "Fit for solving: no hex is invalid or has a scaled Jacobian below 0.2."
    assert line == f"{fit} Next: hexmend {quote(str(path))}"
    assert record["fit"] is True


def test_inverted_hexes_are_counted_and_the_command_mends_them(tmp_path, capsys, run_command):
    path, mesh = tmp_path / "in 1.vtu", gallery.make("cube", size=125, scramble=0.5)
    inverted = int(measure(mesh.points, mesh.hexes).inverted.sum())
    line, record = ended(path, mesh, capsys)
    assert inverted
    assert line.startswith(f"Not fit for solving: {inverted} of 125 hexes ")
    assert (record["fit"], record["next"]) == (False, f"hexmend smooth {quote(str(path))} -o OUT")
    out = tmp_path / "out.vtu"
    run_command("smooth", path, "-o", out)
    assert json.loads(run_command("info", out, "--json").out)["fit"] is True


def test_a_flat_mesh_is_poor(tmp_path, capsys):
    mesh = gallery.make("cube", size=8)
    shear = np.array([[1, 0, 0], [6.0, 1, 0], [0, 0, 1]])  # sine of the angle between edges: 1 / sqrt(37) = 0.16
    line, record = ended(tmp_path / "sheared.vtu", mesh.with_points(mesh.points @ shear), capsys)
    assert line.startswith(
        "Fit for solving, but poor: 8 of 8 hexes have a scaled Jacobian below 0.2. Next: hexmend smooth"
    )
    assert record["fit"] is True


@pytest.mark.parametrize(("solver", "verdict"), [("nastran", "passed"), ("openfoam", "failed")])
def test_a_failed_check_of_the_solver_decides(tmp_path, capsys, solver, verdict):
    mesh = gallery.make("cube", size=8)
    shear = np.array([[1, 0, 0], [30.0, 1, 0], [0, 0, 1]])
    line, record = ended(tmp_path / "sheared.vtu", mesh.with_points(mesh.points @ shear), capsys, "--for", solver)
    assert record["verdict"] == verdict
    assert record["fit"] is (verdict == "passed")
    assert line.startswith("Not fit for solving." if verdict == "failed" else "Fit for solving")


def test_parts_that_are_not_connected_may_be_meant_so(tmp_path, capsys):
    mesh = gallery.make("cube", size=8)
    two = Mesh(np.vstack([mesh.points, mesh.points + [5, 0, 0]]), np.vstack([mesh.hexes, mesh.hexes + mesh.n_nodes]))
    line, record = ended(tmp_path / "assembly.vtu", two, capsys)
    assert line.startswith("Fit for solving, if its parts need not be connected: no hex is invalid")
    assert record["fit"] is True


def test_parts_that_the_file_joins_and_unused_nodes_are_no_faults(tmp_path, capsys):
    mesh = gallery.make("cube", size=8)
    points, hexes = np.vstack([mesh.points, mesh.points + [5, 0, 0], [[9, 9, 9]]]), mesh.hexes
    write(tmp_path / "a.inp", Mesh(points, np.vstack([hexes, hexes + mesh.n_nodes])))
    with open(tmp_path / "a.inp", "a") as deck:
        deck.write("*EQUATION\n2\n1, 1, 1., 28, 1, -1.\n")
    assert main(["info", str(tmp_path / "a.inp")]) == 0
    line = capsys.readouterr().out.splitlines()[-1]
    assert line.startswith("Fit for solving, if its unused nodes may stay: no hex is invalid")


def test_hexes_that_are_invalid_between_their_corners_are_not_fit(tmp_path, capsys, run_command):
    path, out, repaired = tmp_path / "bent.vtu", tmp_path / "out.vtu", tmp_path / "repaired.vtu"
    line, record = ended(path, bent(inside=True), capsys)
    assert line == f"To be repaired before solving: mid nodes. Next: hexmend repair {quote(str(path))} -o OUT"
    assert record["fit"] is False
    run_command("repair", path, "-o", repaired, "--only", "mid-nodes")
    assert json.loads(run_command("info", repaired, "--json").out)["fit"] is True
    assert "made 4 hexes of second order valid" in run_command("smooth", path, "-o", out).out
    assert json.loads(run_command("info", out, "--json").out)["fit"] is True
    write(path, bent(inside=False))
    last = run_command("smooth", path, "-o", out, status=4).out.splitlines()[-1]
    assert last.startswith("Not fit for solving: 1 hex of second order has sound corners, but a Jacobian that is")
    line, record = ended(tmp_path / "edge.vtu", bent(inside=False), capsys)
    assert line.startswith("Not fit for solving: 1 of 8 hexes is invalid inside")


# `hexmend info --for SOLVER`: the table, the verdict, JSON, and unknown solvers.


@pytest.fixture
def kershaw(tmp_path):
    path = tmp_path / "kershaw.vtk"
    write(path, gallery.make("kershaw", size=1728))
    return path


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_table_and_a_verdict_are_printed(kershaw, solver, run_command):
    printed = run_command("info", kershaw, "--for", solver).out
    declared = SOLVERS[solver]
    assert f"{declared.title}: " in printed
    assert declared.omitted in printed
    assert printed.count(QUOTED) == bool(declared.reservation)
    assert declared.checks[0].name in printed


def test_json_has_the_checks(kershaw, run_command):
    answer = json.loads(run_command("info", kershaw, "--for", "OpenFOAM", "--json").out)
    first = answer["checks"][0]
    assert first["name"] == "non-orthogonality"
    assert first["limit"] == 70
    assert first["value"] == pytest.approx(79.59, abs=0.01)
    assert first["verdict"] == "warning"
    assert answer["verdict"] == "failed"  # skewness
    assert "checks" not in json.loads(run_command("info", kershaw, "--json").out)


def test_an_unknown_solver_is_told_before_the_mesh_is_read(tmp_path, capsys):
    assert main(["info", str(tmp_path / "absent.vtk"), "--for", "fluent"]) != 0
    said = capsys.readouterr().err
    assert "there is no solver 'fluent'" in said
    assert "openfoam" in said
