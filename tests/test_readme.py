"""The README is short, its example and its commands run as they stand, and what it names exists."""

import re
import shlex
import tomllib
from pathlib import Path

import pytest

from hexmend import gallery, io
from hexmend.cli.main import commands, main
from hexmend_app.cli import view
from tests.examples import run_page

ROOT = Path(__file__).resolve().parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")
LINES = [
    line.partition("  #")[0].split(";")[0].strip()
    for block in re.findall(r"^```\n(.*?)^```", README, re.DOTALL | re.MULTILINE)
    for line in block.splitlines()
]


def test_the_example_runs(tmp_path):
    said = run_page(ROOT / "README.md", tmp_path).splitlines()
    assert re.match(r"\d+ hexes were inverted, 0 are; q_min 0\.\d+", said[0])
    assert [line.split()[0] for line in said[1:]] == ["1", "2", "3"]
    assert (tmp_path / "mended.vtu").exists()


def test_every_command_runs(tmp_path, monkeypatch, capsys):
    """The window itself is not opened: it gets the mesh that it would show."""
    monkeypatch.chdir(tmp_path)
    io.write("part.vtu", gallery.make("bridge-sharp", size=500, scramble=0.4, seed=1))
    opened = []
    monkeypatch.setattr(view.ViewCommand, "run", lambda self, args: opened.append(args.mesh) or 0)
    ran = [shlex.split(line)[1:] for line in LINES if line.startswith("hexmend")]
    assert [main(words) for words in ran] == [0] * len(ran)
    assert len(ran) == 4
    assert opened == ["part.vtu", None]
    assert "Inverted" in capsys.readouterr().out
    assert io.read("smoothed.vtu").n_hexes == io.read("part.vtu").n_hexes


@pytest.mark.parametrize("line", [line for line in LINES if not line.startswith("hexmend")])
def test_what_is_installed_exists(line):
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    (extra,) = re.fullmatch(r'pip install "\.\[(\w+)\]"', line).groups()
    assert extra in project["optional-dependencies"]


def test_commands_and_files_that_are_named_exist():
    named = set(re.findall(r"`hexmend ([a-z]+)", README))
    assert named
    assert named <= set(commands())
    targets = {line.split(":")[0] for line in (ROOT / "Makefile").read_text(encoding="utf-8").splitlines()}
    assert set(re.findall(r"`make (\w+)`", README)) <= targets
    linked = [path for path in re.findall(r"\]\(([^)#]+)", README) if not path.startswith("https://")]
    assert linked
    for path in linked:
        assert (ROOT / path).exists(), path


def test_figures_that_are_named_are_those_of_the_measurements():
    """The table of measured figures repeats those of the page that it refers to."""
    (table,) = re.findall(r"<!-- measured: five rows -->\n(.*?)<!-- end -->", README, re.DOTALL)
    rows = table.strip().splitlines()[2:]
    assert len(rows) == 5
    measured = (ROOT / "docs/measurements/boundary-results.md").read_text(encoding="utf-8")
    for row in rows:
        name, invalid, given, published, ours = (cell.strip() for cell in row.strip("|").split("|"))
        (line,) = re.findall(rf"^\| {name.split(',')[0]} \| slide \|.*", measured, re.MULTILINE)
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        values = [given.replace("−", "-"), ours.split(",")[0]]
        assert (cells[3], cells[4]) == (invalid, " → ".join(values))
        assert published.startswith(f"{cells[5]}, {cells[9]} %")
        assert ours.endswith(f"{float(cells[8]):.2f} %")


def _cells(line):
    return [cell.strip().replace("−", "-").replace("\\_", "_") for cell in line.strip().strip("|").split("|")]


def _tables(page):
    """Return the rows of all tables of a page of docs as {first cell: [cells]}, one for each table."""
    text = (ROOT / "docs" / page).read_text(encoding="utf-8")
    return [[_cells(line) for line in table.splitlines()] for table in re.findall(r"(?:^\|.*\n)+", text, re.MULTILINE)]


def _table_with(tables, *heads):
    return next(table for table in tables if set(heads) <= set(table[0]))


def test_figures_of_other_programs_are_those_of_the_measurements():
    """Each figure is that of docs/measurements/peers.md, or for hexsmoothing of docs/measurements/performance-mend.md."""
    (table,) = re.findall(r"<!-- measured: peers -->\n(.*?)<!-- end -->", README, re.DOTALL)
    rows = [_cells(line) for line in table.strip().splitlines()[2:]]
    assert len(rows) == 5
    tables = _tables("measurements/peers.md")
    meshes, same = _table_with(tables, "mend, fixed", "Gmsh", "hexes"), _table_with(tables, "mend, p = 1", "TMOP")
    goals = _table_with(_tables("measurements/performance-mend.md"), "mesh, hexes", "scaled Jacobian min")
    for name, inverted, given, ours, smoothing, tmop, gmsh, seconds in rows:
        stem, hexes = name.removesuffix(" hexes").split(", ")
        (row,) = [dict(zip(meshes[0], row, strict=True)) for row in meshes if re.match(rf"{stem}[._]", row[0])]
        assert (row["hexes"], row["inverted"], row["mend, fixed"]) == (hexes, inverted, ours)
        assert [row[key].split(" (")[0] for key in ("sc. Jacobian min as given", "TMOP", "Gmsh")] == [given, tmop, gmsh]
        timed = [row for row in same if re.match(rf"{stem}[._]", row[0])]
        assert [f"{row[3]}, {row[5]}" for row in timed if row[2] == row[4]] == ([seconds] if timed else [])
        assert timed or seconds == "–"
        start = next(i for i, row in enumerate(goals) if re.match(rf"{stem}(_\d+)?, {hexes}$", row[0]))
        (other,) = [row for row in goals[start : start + 5] if row[1] == "hexsmoothing"]
        mean, least = (goals[0].index(head) for head in ("q mean", "scaled Jacobian min"))
        assert other[least] == smoothing
        balanced = next(row for row in goals[start : start + 5] if row[1] == "balanced")
        assert abs(float(balanced[mean]) - float(other[mean])) < 0.00201  # 0.002 in decimals
