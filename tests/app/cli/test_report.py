"""`hexmend report` and `hexmend figures`, with and without a display."""

import hashlib
import json
import os
import shlex
import signal
from pathlib import Path

import pytest
from PIL import Image

from hexmend import gallery, io
from hexmend.cli import main as program
from hexmend.run import memory
from hexmend_app.cli import figure_set, report
from hexmend_app.report import case, page

pytestmark = pytest.mark.slow

METHODS = ["--methods", "laplacian,mend", "--max-iterations", "8"]


@pytest.fixture(scope="module")
def mesh_file(tmp_path_factory):
    """File of a small mesh with inverted hexes."""
    path = tmp_path_factory.mktemp("mesh") / "bridge.vtu"
    io.write(path, gallery.make("bridge-sharp", size=256, scramble=0.4, seed=1))
    return path


@pytest.fixture
def hexmend(monkeypatch):
    """Run the command line, and return its exit status."""
    own = {"report": lambda: report.command, "figures": lambda: figure_set.command}
    monkeypatch.setattr(program, "commands", lambda: own)
    return lambda *words: program.main([*map(str, words)])


def test_a_report_contains_mesh_methods_and_commands(hexmend, mesh_file, tmp_path):
    path = tmp_path / "report.html"
    assert hexmend("report", mesh_file, *METHODS, "--title", "a < b", "-o", path) == 0
    text = path.read_text(encoding="utf-8")
    assert hashlib.sha256(mesh_file.read_bytes()).hexdigest() in text
    assert "<h1>a &lt; b</h1>" in text
    for said in ("laplacian", "mend", "The worst hexes", "Locked hexes", "max_iterations 8", "SHA-256"):
        assert said in text
    assert f"hexmend report {mesh_file} {' '.join(METHODS)} --title" in text
    assert "http" not in text.replace("http-equiv", "")  # nothing is asked of a network


@pytest.mark.parametrize("name", ["-- 'two words' & <b>$x_{.vtu", "odd\udcff.vtu"])
def test_any_file_name_works(hexmend, mesh_file, tmp_path, monkeypatch, name):
    monkeypatch.chdir(tmp_path)
    Path(name).write_bytes(mesh_file.read_bytes())
    words = ["--methods", "none", "-o"]
    assert hexmend("report", f"./{name}", *words, "report.html") == 0
    assert hexmend("figures", f"./{name}", "--width-mm", "60", *words, "set") == 0
    assert "<b>" not in Path("report.html").read_text(encoding="utf-8")
    assert Path("set/captions.md").exists()


def test_a_figure_set_has_its_captions_and_its_commands(hexmend, mesh_file, tmp_path):
    folder = tmp_path / "set"
    names = ["--names", "Given,Smoothed,Mended", "--width-mm", "120", "--format", "png,svg", "--view", "-x"]
    assert hexmend("figures", mesh_file, *METHODS, *names, "-o", folder) == 0
    parts = ("surface", "behind", "cut", "distributions", "convergence")
    expected = {f"{part}.{kind}" for part in parts for kind in ("png", "svg")}
    expected |= {f"table.{kind}" for kind in ("csv", "md", "tex", "json")} | {"captions.md", "commands.sh"}
    assert {path.name for path in folder.iterdir()} == expected
    with Image.open(folder / "surface.png") as picture:
        assert picture.width == round(120 / 25.4 * 300)
    assert "Given, Smoothed and Mended" in (folder / "captions.md").read_text()
    assert [row["name"] for row in json.loads((folder / "table.json").read_text())["rows"]] == ["Smoothed", "Mended"]
    lines = (folder / "commands.sh").read_text().splitlines()
    again = [shlex.split(line)[1:] for line in lines if line.startswith("hexmend")]
    assert [words[-1] for words in again] == [*parts, "table"]
    before = (folder / "distributions.svg").read_bytes(), (folder / "surface.png").read_bytes()
    for words in (again[0], again[3]):
        assert hexmend(*words) == 0
    assert ((folder / "distributions.svg").read_bytes(), (folder / "surface.png").read_bytes()) == before


ERRORS = [
    (["report", "-o", "a.docx"], "a.docx"),
    (["report", "-o", "a.html", "--methods", "lapalcian"], "lapalcian"),
    (["report", "-o", "a.html", "--names", "one"], "--names 'one' cannot be used: expected 2 different names"),
    (["figures", "-o", "set", "--format", "gif"], "--format 'gif' cannot be used"),
    (["figures", "-o", "set", "--width-mm", "1"], "a width from 40 to 1000 mm"),
    (["figures", "-o", "set", "--only", "table,cut"], "--only 'table,cut' cannot be used: expected one of surface"),
    (["figures", "-o", "set", "--width-mm", "1000", "--methods", "none"], "1 picture on a page 1000 mm wide: the page"),
    (
        ["figures", "-o", "set", "--width-mm", "1000", "--methods", "mend,laplacian,getme"],
        "expected at most 67,108,864",
    ),
    (["report", "-o", "a.html", "--scene", "../fine.toml"], "2 pictures on a page 170 mm wide: the page has"),
]


@pytest.mark.parametrize(("words", "said"), ERRORS)
def test_errors_are_reported_before_the_runs(hexmend, mesh_file, tmp_path, monkeypatch, capsys, words, said):
    monkeypatch.chdir(tmp_path)
    Path("../fine.toml").write_text("[page]\ndpi = 2400", encoding="utf-8")
    command, *others = words
    assert hexmend(command, mesh_file, *others) in (2, 3)
    (line,) = capsys.readouterr().err.splitlines()
    assert said in line
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("words", [["report", "-o", "a.html"], ["figures", "-o", "set"]])
def test_runs_without_enough_memory_are_rejected(hexmend, mesh_file, tmp_path, monkeypatch, capsys, words):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(memory, "available", lambda: 1000)
    command, *others = words
    assert hexmend(command, mesh_file, *others) == 3
    assert "--force" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


@pytest.fixture
def interrupting(monkeypatch):
    """Make functions send signals to this process before their work."""

    def interrupt(module, name, number=signal.SIGINT, times=1, call=1):
        whole, calls = getattr(module, name), []

        def interrupted(*args, **options):
            calls.append(name)
            for _ in range(times if len(calls) == call else 0):
                os.kill(os.getpid(), number)
            return whole(*args, **options)

        monkeypatch.setattr(module, name, interrupted)

    return interrupt


def test_a_report_is_written_though_signals_come_in_its_runs_and_while_it_is_drawn(
    hexmend, mesh_file, tmp_path, capsys, interrupting
):
    interrupting(case, "run_one", signal.SIGTERM)  # the first: this run ends after its iteration
    interrupting(page, "draw_chapter", signal.SIGTERM)
    path = tmp_path / "report.html"
    assert hexmend("report", mesh_file, *METHODS, "-o", path) == 128 + signal.SIGTERM
    assert "The runs were interrupted" in path.read_text(encoding="utf-8")
    assert "Interrupted: the report shows the results so far." in capsys.readouterr().err


def test_a_signal_while_the_second_mesh_is_read_keeps_the_first(hexmend, mesh_file, tmp_path, interrupting):
    interrupting(case, "source_of", call=2)
    path = tmp_path / "report.html"
    assert hexmend("report", mesh_file, mesh_file, *METHODS, "-o", path) == 130
    assert path.read_text(encoding="utf-8").count("SHA-256") == 1


def test_a_signal_while_the_first_mesh_is_read_leaves_nothing(hexmend, mesh_file, tmp_path, interrupting):
    interrupting(case, "source_of")
    assert hexmend("report", mesh_file, *METHODS, "-o", tmp_path / "report.html") == 130
    assert list(tmp_path.iterdir()) == []
