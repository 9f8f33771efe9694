"""The commands that `smooth` prints as advice can be run as they are, and help."""

import shlex

import numpy as np
import pytest

from hexmend import METHODS, MotionRules, Recipe, StoppingCriteria, gallery, io, summarise, write_recipe
from hexmend.advice import Suggestion
from hexmend.cli.commands.smooth.suggested_command import RunOptions, suggested_command
from hexmend.cli.main import main
from tests.core.boundary.solids import ball, slid
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


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--rings", "2"], "--rings 2 is for a part of the mesh: name it with --only, or leave it out"),
        (["--only", "some", "--rings", "-1"], "--rings -1 is out of bounds: expected a number of at least 0"),
    ],
)
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
