"""The figure set of what a window shows."""

import argparse
import json
import shlex

import pytest
from PIL import Image
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QPushButton

from hexmend.run import StoppingCriteria
from hexmend.smoothers import METHODS
from hexmend_app.bench.windows import end_run
from hexmend_app.cli import figure_set
from hexmend_app.features.figures.shown import shown_in
from hexmend_app.picture import read_scene
from tests.app.driving import LEFT
from tests.app.features.timeline.test_feature import stepped
from tests.patience import PATIENCE


@pytest.fixture
def asked(tmp_path, monkeypatch):
    folder = tmp_path / "set"
    monkeypatch.setattr("hexmend_app.features.figures.feature.ask_figures", lambda parent, stem: str(folder))
    return folder


@pytest.mark.slow
def test_the_set_shows_what_was_opened_what_is_and_what_was_compared(window, qtbot, asked):
    stepped(window, qtbot, 4)
    end_run(window.session)
    comparison = window.session.comparison
    comparison.start([METHODS["laplacian"](), METHODS["getme"]()], StoppingCriteria(max_iterations=3))
    qtbot.waitUntil(lambda: not comparison.busy, timeout=PATIENCE)
    names = [name for name, *_ in shown_in(window.session)]
    assert names == ["initial", "Local steepest descent", "Laplacian", "GETMe, simultaneous"]
    window.session.view.colour_by("q-change")
    window.refresh()
    window.window_actions["figure_set"].trigger()
    qtbot.waitUntil(lambda: not window.features["figures"].going_on, timeout=PATIENCE)
    assert "Figure set saved" in " ".join(window.messages.messages()[-1])
    parts = {path.stem for path in asked.glob("*.png")}
    assert parts == {"surface", "cut", "distributions", "convergence"}
    rows = json.loads((asked / "table.json").read_text())["rows"]
    assert [row["name"] for row in rows] == names[1:]
    assert read_scene(asked / "scene.toml").colours.metric == "q"  # a change needs a mesh that has moved
    with Image.open(asked / "surface.png") as picture:
        assert picture.convert("L").getextrema()[0] < 100
    commands = [line for line in (asked / "commands.sh").read_text().splitlines() if line.startswith("hexmend")]
    assert len(commands) == 5
    words = shlex.split(commands[0])
    assert f"{asked}/run.toml,{asked}/laplacian.toml,{asked}/getme.toml" in words
    drawn = (asked / "distributions.svg").read_text()
    again = figure_set.command
    parser = argparse.ArgumentParser()
    again.arguments(parser)
    (repeated,) = [shlex.split(one)[2:] for one in commands if one.endswith("distributions")]
    assert again.run(parser.parse_args(repeated)) == 0
    assert (asked / "distributions.svg").read_text() == drawn
    assert str(window.session.document.path) in words


def test_it_can_be_given_up(window, qtbot, asked):
    window.window_actions["figure_set"].trigger()
    feature = window.features["figures"]
    assert feature.going_on
    assert not window.features["figures"].actions()[0].enabled()
    cancel = next(b for b in window.busy.findChildren(QPushButton) if b.text() == "Cancel")
    QTest.mouseClick(cancel, LEFT)
    assert not feature.going_on
    assert not (asked / "captions.md").exists()


def test_a_folder_that_cannot_be_made_is_told(window, asked):
    asked.write_text("a file")
    window.window_actions["figure_set"].trigger()
    assert not window.features["figures"].going_on
    assert "is a file" in " ".join(window.messages.messages()[-1])
