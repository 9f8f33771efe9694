"""Films, reports and figure sets, drawn in the background."""

import argparse
import json
import shlex
from itertools import pairwise

import numpy as np
import pytest
from PIL import Image
from PySide6.QtTest import QTest

from benchmarks.window.windows import end_run
from hexmend import METHODS, StoppingCriteria
from hexmend_app.cli import figure_set
from hexmend_app.features.export.page_dialog import PageDialog
from hexmend_app.features.export.report_files import versions_of
from hexmend_app.picture import read_scene
from tests.app.driving import LEFT, button, turn
from tests.app.features.timeline.test_feature import stepped


@pytest.fixture
def export(window, qtbot, tmp_path, monkeypatch):
    """A function that exports from the dialog to a file, with values of a film, and returns its path."""

    def export(action, name, what=None, wait=True, **values):
        def accept(dialog):
            if what is not None:
                dialog.choose(what)
            for key, value in values.items():
                dialog.settings.form.editors[key].set_value(value)
            dialog.target.line.setText(str(tmp_path / name))
            dialog.accept()
            return dialog.result()

        monkeypatch.setattr(PageDialog, "exec", accept)
        window.window_actions[action].trigger()
        if wait:
            qtbot.waitUntil(lambda: not window.features["export"].going_on)
        return tmp_path / name

    return export


@pytest.fixture
def texts(window, monkeypatch):
    """The progress texts."""
    texts = []
    show = window.busy.show_work
    monkeypatch.setattr(
        window.busy, "show_work", lambda owner, text, *others: (texts.append(text), show(owner, text, *others))
    )
    return texts


@pytest.mark.slow
@pytest.mark.parametrize("suffix", [".gif", ".png"])
def test_a_film_shows_the_run_as_in_the_view(window, qtbot, export, texts, suffix):
    record = stepped(window, qtbot, 5)
    window.canvas.look_along("+x")
    shown = window.session.timeline.shown_iteration
    path = export("film", f"run{suffix}", rate=20)
    assert texts[1:7] == [f"{path.name}: drawing picture {k} of 6…" for k in range(1, 7)]
    assert "Film saved" in " ".join(window.messages.messages()[-1])
    with Image.open(path) as film:
        assert (film.n_frames, film.width) == (record.newest + 1, 960)
        frames = []
        for k in range(film.n_frames):
            film.seek(k)
            frames.append(np.asarray(film.convert("RGB")).astype(int))
    middle = slice(frames[0].shape[0] // 4, -frames[0].shape[0] // 4)
    assert all((a[middle] != b[middle]).any() for a, b in pairwise(frames))
    assert window.session.timeline.shown_iteration == shown
    assert window.busy.isHidden()


def test_a_film_can_be_cancelled(window, qtbot, export, tmp_path):
    stepped(window, qtbot, 5)
    path = export("film", "run.gif", wait=False, before=True, histogram=True)
    QTest.mouseClick(button(window.busy, "Cancel"), LEFT)
    assert not window.features["export"].going_on
    turn()
    assert not path.exists()


def test_a_film_that_cannot_be_written_is_reported(window, qtbot, export):
    stepped(window, qtbot, 2)
    path = export("film", "missing/run.gif")
    assert window.messages.messages()[-1][:2] == ("error", "Film not saved")
    assert window.busy.isHidden()
    assert not path.exists()


@pytest.mark.slow
def test_the_set_contains_the_opened_the_current_and_the_compared_meshes(window, qtbot, export):
    stepped(window, qtbot, 4)
    end_run(window.session)
    comparison = window.session.comparison
    comparison.start([METHODS["laplacian"](), METHODS["getme"]()], StoppingCriteria(max_iterations=3))
    qtbot.waitUntil(lambda: not comparison.busy)
    names = [version.name for version in versions_of(window.session)]
    assert names == ["initial", "Local steepest descent", "Laplacian", "GETMe, simultaneous"]
    window.session.view.colour_by("q-change")
    window.refresh()
    folder = export("report", "set", "figures")
    assert "Figure set saved" in " ".join(window.messages.messages()[-1])
    parts = {path.stem for path in folder.glob("*.png")}
    assert parts == {"surface", "behind", "cut", "distributions", "convergence"}
    rows = json.loads((folder / "table.json").read_text())["rows"]
    assert [row["name"] for row in rows] == names[1:]
    assert read_scene(folder / "scene.toml").colours.metric == "q"  # the change of q needs a smoothed mesh
    with Image.open(folder / "surface.png") as picture:
        assert picture.convert("L").getextrema()[0] < 100
    commands = [line for line in (folder / "commands.sh").read_text().splitlines() if line.startswith("hexmend")]
    assert len(commands) == 6
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


@pytest.mark.slow
def test_each_step_of_a_report_is_shown_and_the_report_can_be_cancelled(window, export, texts):
    page = export("report", "report.html", wait=False)
    QTest.mouseClick(button(window.busy, "Cancel"), LEFT)
    assert not window.features["export"].going_on
    assert not page.exists()
    texts.clear()
    export("report", "report.html")
    # opposite side, surface, cut and distributions; there is no run that converges
    assert texts == [f"report.html: drawing picture {number}…" for number in range(1, 6)]
    assert page.exists()
