"""Films of a run, drawn in the background."""

from itertools import pairwise

import numpy as np
import pytest
from PIL import Image
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QComboBox, QSpinBox

from hexmend_app.features.film.film_dialog import FilmChoice, FilmDialog
from hexmend_app.picture import Page, Scene
from hexmend_app.scene.page.layout import Layout
from hexmend_app.scene.page.page_mesh import PageMesh
from tests.app.driving import LEFT, button, named, turn
from tests.app.features.timeline.test_feature import stepped
from tests.core.grids import grid


@pytest.fixture(autouse=True)
def accepted(monkeypatch):
    """Accept the dialog with a width of 640 pixels and 20 frames per second."""

    def accept(dialog):
        size = named(dialog, QComboBox, "Size")
        size.setCurrentIndex(size.findData(640))
        named(dialog, QSpinBox, "Rate").setValue(20)
        return True

    monkeypatch.setattr(FilmDialog, "exec", accept)


@pytest.mark.parametrize("histogram", [False, True])
@pytest.mark.parametrize("width", [640, 2560])
def test_a_picture_next_to_that_before_the_run_is_as_wide_as_the_view(width, histogram):
    view = 1000, 600
    size = FilmChoice(width, histogram=histogram, before=True).size(view)
    meshes = [PageMesh.of(grid(1), name) for name in "ab"]
    wide, high = Layout.of(Scene(page=Page(pixels=size)), meshes, histogram=histogram).panel
    assert 0 <= wide / high - view[0] / view[1] < 0.1


@pytest.mark.slow
@pytest.mark.parametrize("suffix", [".gif", ".png"])
def test_a_film_shows_the_run_as_in_the_view(window, qtbot, tmp_path, monkeypatch, suffix):
    record = stepped(window, qtbot, 5)
    window.canvas.look_along("+x")
    path = tmp_path / f"run{suffix}"
    monkeypatch.setattr("hexmend_app.features.film.feature.ask_film", lambda parent, stem: str(path))
    shown = window.session.timeline.shown_iteration
    window.window_actions["film"].trigger()
    texts = [window.busy.text()]
    show = window.busy.show_work
    monkeypatch.setattr(
        window.busy, "show_work", lambda owner, text, *others: (texts.append(text), show(owner, text, *others))
    )
    qtbot.waitUntil(lambda: not window.features["film"].going_on)
    assert texts == [*(f"Drawing frame {k} of 6…" for k in range(1, 7)), f"Writing {path.name}…"]
    assert "6 frames" in " ".join(window.messages.messages()[-1])
    with Image.open(path) as film:
        assert (film.n_frames, film.width) == (record.newest + 1, 640)
        frames = []
        for k in range(film.n_frames):
            film.seek(k)
            frames.append(np.asarray(film.convert("RGB")).astype(int))
    middle = slice(frames[0].shape[0] // 4, -frames[0].shape[0] // 4)
    assert all((a[middle] != b[middle]).any() for a, b in pairwise(frames))
    assert window.session.timeline.shown_iteration == shown
    assert window.busy.isHidden()


def test_a_film_can_be_cancelled_and_a_wrong_suffix_is_reported(window, qtbot, tmp_path, monkeypatch):
    stepped(window, qtbot, 5)
    path = tmp_path / "run.gif"
    monkeypatch.setattr("hexmend_app.features.film.feature.ask_film", lambda parent, stem: str(path))
    window.window_actions["film"].trigger()
    QTest.mouseClick(button(window.busy, "Cancel"), LEFT)
    assert not window.features["film"].going_on
    turn()
    assert list(tmp_path.glob("*.gif")) == []
    path = tmp_path / "run.avi"
    window.window_actions["film"].trigger()
    assert not window.features["film"].going_on
    assert "Use .mp4, .gif, .png or .webp." in " ".join(window.messages.messages()[-1])
