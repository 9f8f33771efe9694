"""Figure sets exported from the window."""

import argparse
import json
import shlex

import pytest
from PIL import Image
from PySide6.QtTest import QTest

from benchmarks.window.windows import end_run
from hexmend import METHODS, StoppingCriteria
from hexmend_app.cli import figure_set
from hexmend_app.features.figures.exports import versions_of
from hexmend_app.picture import read_scene
from tests.app.driving import LEFT, button
from tests.app.features.timeline.test_feature import stepped


@pytest.fixture
def folder(tmp_path, monkeypatch):
    path = tmp_path / "set"
    monkeypatch.setattr("hexmend_app.features.figures.feature.ask_figures", lambda parent, stem: str(path))
    return path


@pytest.mark.slow
def test_the_set_contains_the_opened_the_current_and_the_compared_meshes(window, qtbot, folder):
    stepped(window, qtbot, 4)
    end_run(window.session)
    comparison = window.session.comparison
    comparison.start([METHODS["laplacian"](), METHODS["getme"]()], StoppingCriteria(max_iterations=3))
    qtbot.waitUntil(lambda: not comparison.busy)
    names = [name for name, *_ in versions_of(window.session)]
    assert names == ["initial", "Local steepest descent", "Laplacian", "GETMe, simultaneous"]
    window.session.view.colour_by("q-change")
    window.refresh()
    window.window_actions["figure_set"].trigger()
    qtbot.waitUntil(lambda: not window.features["figures"].going_on)
    assert "Figure set saved" in " ".join(window.messages.messages()[-1])
    parts = {path.stem for path in folder.glob("*.png")}
    assert parts == {"surface", "cut", "distributions", "convergence"}
    rows = json.loads((folder / "table.json").read_text())["rows"]
    assert [row["name"] for row in rows] == names[1:]
    assert read_scene(folder / "scene.toml").colours.metric == "q"  # the change of q needs a smoothed mesh
    with Image.open(folder / "surface.png") as picture:
        assert picture.convert("L").getextrema()[0] < 100
    commands = [line for line in (folder / "commands.sh").read_text().splitlines() if line.startswith("hexmend")]
    assert len(commands) == 5
    arguments = shlex.split(commands[0])
    assert f"{folder}/run.toml,{folder}/laplacian.toml,{folder}/getme.toml" in arguments
    figure = (folder / "distributions.svg").read_text()
    command = figure_set.command
    parser = argparse.ArgumentParser()
    command.arguments(parser)
    (repeated,) = [shlex.split(line)[2:] for line in commands if line.endswith("distributions")]
    assert command.run(parser.parse_args(repeated)) == 0
    assert (folder / "distributions.svg").read_text() == figure
    assert str(window.session.document.path) in arguments


def test_the_export_can_be_cancelled(window, qtbot, folder):
    window.window_actions["figure_set"].trigger()
    feature = window.features["figures"]
    assert feature.going_on
    assert not window.features["figures"].actions()[0].enabled()
    QTest.mouseClick(button(window.busy, "Cancel"), LEFT)
    assert not feature.going_on
    assert not (folder / "captions.md").exists()


@pytest.fixture
def page(tmp_path, monkeypatch):
    path = tmp_path / "report.html"
    monkeypatch.setattr("hexmend_app.features.figures.feature.ask_report", lambda parent, stem: str(path))
    return path


@pytest.mark.slow
def test_each_step_of_a_report_is_named_and_the_report_can_be_cancelled(window, qtbot, page, monkeypatch):
    texts = []
    show = window.busy.show_work
    monkeypatch.setattr(
        window.busy, "show_work", lambda owner, text, *others: (texts.append(text), show(owner, text, *others))
    )
    window.window_actions["report"].trigger()
    QTest.mouseClick(button(window.busy, "Cancel"), LEFT)
    assert not window.features["figures"].going_on
    assert not page.exists()
    texts.clear()
    window.window_actions["report"].trigger()
    qtbot.waitUntil(lambda: not window.features["figures"].going_on)
    parts = ("opposite side", "surface", "cut", "distributions")  # there is no run that converges
    drawing = [f"Drawing figure {number} of 4: {part}…" for number, part in enumerate(parts, 1)]
    assert texts == [*drawing, f"Writing {page.name}…"]
    assert page.exists()
