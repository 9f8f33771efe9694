"""The pages of docs: what they say can be done."""

import argparse
import re
import shlex
import subprocess
import sys
import tomllib
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from hexmend import gallery, io, smooth
from hexmend.cli.main import commands, main
from hexmend.run import recipe
from hexmend_app.cli import view
from hexmend_app.formats.session import session_file
from hexmend_app.picture import scene
from hexmend_app.scene.page import page_captions
from tests.examples import blocks, run_page

DOCS = Path(__file__).resolve().parents[1] / "docs"
PAGES = sorted(path for path in DOCS.rglob("*.md") if path.parent.name != "api")


def test_every_script_of_pictures_is_run_by_make_pictures():
    scripts = {path.stem for path in (DOCS.parent / "scripts/pictures").glob("*.py")} - {"screenshots"}
    text = (DOCS.parent / "scripts/take-pictures").read_text(encoding="utf-8")
    listed = " ".join(re.findall(r"for script in (.*); do", text)).split()
    single = re.findall(r"^(?: *|\[.*\] \|\| )take (\w+)", text, re.MULTILINE)
    assert {*listed, *single} == scripts


@pytest.mark.slow
def test_the_animation_of_the_readme_says_the_truth(tmp_path, monkeypatch):
    """The figures in its first and last frames are those that the commands of its page lead to."""
    monkeypatch.chdir(tmp_path)
    (block,) = re.findall(r"```\n(hexmend gallery five-side.*?)```", (DOCS / "methods/watch.md").read_text(), re.DOTALL)
    make, draw = block.replace("\\\n", " ").splitlines()
    assert main(shlex.split(make)[1:]) == 0
    captions = []
    draw_captions = page_captions.draw_captions

    def record(drawing, layout):
        captions.append([(mesh.name, mesh.text) for mesh in layout.meshes])
        draw_captions(drawing, layout)

    monkeypatch.setattr("hexmend_app.scene.page.page_renderer.draw_captions", record)
    assert main([*shlex.split(draw)[1:], "--frames", "2"]) == 0
    mesh = io.read("five-side.vtu")
    after = smooth(mesh)
    inside = after.before.invalid - after.before.inverted
    first = f"q min {after.before.q_min:.4f}, {after.before.inverted:,} inverted, {inside} invalid inside"
    last = f"q min {after.after.q_min:.4f}, none invalid"
    count = after.iterations
    assert captions[0] == [("Before", first), (f"iteration 0 of {count}", first)]
    assert captions[-1] == [("Before", first), (f"iteration {count} of {count}", last)]


@pytest.mark.slow
def test_the_animation_of_the_readme_is_as_it_is_drawn(tmp_path):
    """In processes of their own: pixels depend on what graphics a process has used before."""
    (block,) = re.findall(r"```\n(hexmend gallery five-side.*?)```", (DOCS / "methods/watch.md").read_text(), re.DOTALL)
    for line in block.replace("\\\n", " ").splitlines():
        subprocess.run([sys.executable, "-m", *shlex.split(line)], cwd=tmp_path, check=True, capture_output=True)
    with Image.open(tmp_path / "before-after.gif") as made, Image.open(DOCS / "pictures/before-after.gif") as kept:
        assert (made.n_frames, made.size) == (kept.n_frames, kept.size)
        difference = abs(np.asarray(made.convert("RGB")).astype(int) - np.asarray(kept.convert("RGB")))
        assert difference.mean() < 1, "docs/pictures/before-after.gif: run make pictures"


@pytest.mark.slow
def test_what_the_tutorial_says_can_be_done(tmp_path, monkeypatch, capsys):
    text = (DOCS / "start/tutorial.md").read_text(encoding="utf-8")
    listed = "".join(re.findall(r"^```\n(.*?)^```", text, re.DOTALL | re.MULTILINE))
    commands = [line.split()[1:] for line in re.findall(r"^hexmend .+", listed, re.MULTILINE)]
    assert {words[0] for words in commands} == {"gallery", "info", "smooth", "compare", "render", "report"}
    monkeypatch.chdir(tmp_path)
    assert [main(words) for words in commands] == [0] * len(commands)
    for words in commands:
        for file in re.findall(r"\S+\.(?:vtu|pdf|json|html)", " ".join(words)):
            assert (tmp_path / file).is_file()
    said = capsys.readouterr().out
    for figure in re.findall(r"[\d,]+(?= hexes| of them inverted| iterations)", text):
        assert figure in said
    (program,) = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    exec(compile(program, "tutorial.md", "exec"), {})
    assert io.read("mended.vtu").n_hexes == io.read("bridge.vtu").n_hexes


@pytest.mark.slow
@pytest.mark.parametrize(
    "page", [page for page in PAGES if blocks(page) and page.name != "tutorial.md"], ids=lambda page: page.name
)
def test_the_python_of_a_page_runs_as_it_stands(page, tmp_path):
    """That of the tutorial is run by the test above, after its commands; that of the README by its own."""
    run_page(page, tmp_path)


def test_every_block_of_python_is_known_by_its_fence():
    for page in (*PAGES, DOCS.parent / "README.md"):
        text = page.read_text(encoding="utf-8")
        assert not re.search(
            r"^ *(```|~~~) *(py|pycon|python3|ipython)\b|^ *~~~ *python|^ +```python|^```python .", text, re.MULTILINE
        ), page.name
        assert text.count("```python") == len(blocks(page))


@pytest.mark.parametrize(
    "scene", re.findall(r"```toml\n(.*?)```", (DOCS / "results/figures.md").read_text("utf-8"), re.DOTALL)
)
def test_the_scenes_of_the_docs_are_scenes(scene):
    from hexmend_app.picture import Scene, from_toml

    assert from_toml(scene) != Scene()


def command_lines():
    """List the commands in blocks of the pages, each with its page."""
    for page in (*PAGES, DOCS.parent / "README.md"):
        for block in re.findall(r"^```(?:sh)?\n(.*?)^```", page.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE):
            for line in block.replace("\\\n", " ").splitlines():
                if found := re.match(r"(?:srun \S+ |mpiexec -n \d+ )?(?:\S*/)?hexmend( .*|$)", line):
                    yield page.name, found[1].partition("  #")[0].strip()


@pytest.mark.parametrize("page", sorted({page for page, _ in command_lines()}))
def test_the_options_of_commands_exist(page):
    loaders = commands()
    for name, line in command_lines():
        name_of_command, *arguments = shlex.split(line.replace("…", "").replace("[OPTION]...", "")) or ["view"]
        if name != page or name_of_command not in loaders:
            assert (
                name != page or name_of_command.startswith("-") or "." in name_of_command or name_of_command.isupper()
            )
            continue
        parser = argparse.ArgumentParser(allow_abbrev=False, exit_on_error=False)
        loaders[name_of_command]().arguments(parser)
        known = set(re.findall(r"(?<![\w-])--?[a-z][\w-]*", parser.format_help()))
        used = {word for word in arguments if re.match(r"--?[a-z]", word)}
        assert used <= known, f"{name}: hexmend {line}"


def test_the_versions_of_files_are_those_of_the_program():
    text = (DOCS / "reference/versions.md").read_text(encoding="utf-8")
    for kind, version in (("recipe", recipe.FORMAT), ("scene", scene.FORMAT), ("session", session_file.VERSION)):
        (line,) = re.findall(rf"^\| {kind} .*", text, re.MULTILINE)
        assert [cell.strip() for cell in line.split("|")][3] == str(version)
    assert f"`version` ({session_file.VERSION})" in (DOCS / "results/session.md").read_text(encoding="utf-8")


# The README is short, its example and its commands run as they stand, and what it names exists.


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
