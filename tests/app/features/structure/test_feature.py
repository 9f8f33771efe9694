"""Layers of the structure in the window, by mouse and keys."""

import numpy as np
import pytest
from PySide6.QtCore import Qt

from hexmend import Cells, Mesh, io
from hexmend_app.picture.appearance import Look, Structure
from hexmend_app.picture.page import Page
from tests.app.driving import open_and_wait, tick
from tests.app.features.structure.layers import open_and_know, pixels, press_key, texts
from tests.core.curved_shell import curved_shell
from tests.core.grids import displaced, grid


def test_a_key_shows_and_hides_a_layer(five):
    before = pixels(five)
    box = five.features["structure"].panel.layers["irregular"].box
    press_key(five, "irregular")
    assert five.session.view.look.structure == Structure.of("irregular")
    assert box.isChecked()
    assert five.window_actions["show_irregular"].isChecked()
    assert (np.abs(pixels(five) - before).sum(axis=2) > 60).sum() > 100
    press_key(five, "irregular")
    assert five.session.view.look == Look(page=Page(shading=False))
    np.testing.assert_array_equal(pixels(five), before)


@pytest.mark.slow
def test_other_cells_are_shown_and_reported(window, qtbot, tmp_path):
    bare = grid(2, 2, 1)
    tip = bare.points[bare.hexes[0, 4:]].mean(axis=0) + [0, 0, 1]
    pyramid = Cells("pyramid", np.array([[*bare.hexes[0, 4:], bare.n_nodes]]))
    io.write(tmp_path / "mixed.exo", Mesh(np.vstack([bare.points, tip]), bare.hexes, cells=(pyramid,)))
    open_and_know(qtbot, window, tmp_path / "mixed.exo")
    (message,) = window.messages.messages()
    assert "1 pyramid cell next to the hexes" in message[2]
    assert window.canvas.viewport.overlay_layers.optional["others"].shown
    layer = window.features["structure"].panel.layers["others"]
    assert layer.box.isVisibleTo(window.features["structure"].panel)
    assert texts(window.features["structure"].panel, "others") == ["1 pyramid"]
    io.write(tmp_path / "plain.exo", bare)
    open_and_know(qtbot, window, tmp_path / "plain.exo")
    assert "next to the hexes" not in window.messages.text.text()
    assert not window.canvas.viewport.overlay_layers.optional["others"].shown
    assert not layer.box.isVisibleTo(window.features["structure"].panel)


# The switch of curved faces in the window, and curved faces while a method runs.


def shell():
    """Return a shell with free nodes that are moved away from their places."""
    mesh = curved_shell(20, through=3, around=3, along=3)
    shift = np.random.default_rng(0).normal(scale=0.05, size=(np.count_nonzero(mesh.free), 3))
    return displaced(mesh, mesh.free, shift)


@pytest.fixture
def opened(window, qtbot, tmp_path):
    io.write(tmp_path / "shell.vtu", shell())
    open_and_wait(qtbot, window, tmp_path / "shell.vtu")
    window.refresh()
    return window


def parts(window):
    """Return the number of drawn polygons for each visible face."""
    layer = window.canvas.viewport.mesh_layer
    return layer.whole.n_cells / len(layer.faces.quads)


@pytest.mark.slow
def test_the_switch_is_on_for_hexes_with_mid_nodes_and_not_offered_for_others(opened, qtbot, tmp_path):
    box, action = opened.features["structure"].panel.layers["curved"].box, opened.window_actions["show_curved"]
    assert action.isEnabled()
    assert action.isChecked()
    assert parts(opened) == 64
    opened.show_panel("show")
    tick(box)
    assert not action.isChecked()
    assert parts(opened) == 1
    action.trigger()
    opened.refresh()
    assert box.checkState() == Qt.CheckState.Checked
    assert parts(opened) == 64
    io.write(tmp_path / "grid.vtu", grid(3))
    open_and_wait(qtbot, opened, tmp_path / "grid.vtu")
    opened.refresh()
    assert not action.isEnabled()
    assert not box.isVisibleTo(opened)
    assert parts(opened) == 1
