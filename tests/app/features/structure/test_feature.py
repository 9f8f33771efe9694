"""Layers of the structure in the window, by mouse and keys."""

from __future__ import annotations

import numpy as np
import pytest

from hexmend import io
from hexmend.boundary import NodeClass
from hexmend.mesh.cells import Cells
from hexmend.mesh.mesh import Mesh
from hexmend_app.picture.appearance import Look, Structure
from hexmend_app.picture.page import Page
from hexmend_app.scene.layers.optional.structure import KINDS
from hexmend_app.state.mesh.document import State
from tests.app.driving import choose
from tests.app.features.structure.layers import count, open_and_know, pixels, press_key, texts
from tests.core.grids import grid
from tests.patience import PATIENCE


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
def test_kinds_of_nodes_follow_the_feature_angle(five, qtbot):
    press_key(five, "kinds")
    qtbot.waitUntil(lambda: five.canvas.viewport.frame.look.structure.is_on("kinds"), timeout=PATIENCE)
    panel = five.features["structure"].panel
    classes = five.session.boundary_classifier.classes
    assert texts(panel, "kinds")[0] == f"{classes.count(NodeClass.CORNER)} corners"
    assert count(pixels(five), KINDS[NodeClass.PATCH]) > 100
    assert classes.count(NodeClass.CURVE)
    with qtbot.waitSignal(five.session.boundary_classifier.found, timeout=PATIENCE):
        choose(five, "mend", feature_angle=180)
    five.refresh()
    after = five.session.boundary_classifier.classes
    assert 0 < after.count(NodeClass.CURVE) < classes.count(NodeClass.CURVE)  # the rims of sets stay curves
    mesh = five.session.document.now.mesh
    in_sets = np.unique(np.concatenate(list(mesh.node_sets.values())))
    assert np.isin(np.flatnonzero(after.kinds == NodeClass.CURVE), in_sets).all()
    assert f"{after.count(NodeClass.CURVE)} on curves" in texts(panel, "kinds")


@pytest.mark.slow
def test_the_original_surface_is_that_of_the_opened_mesh(five):
    press_key(five, "original")
    window, opened = five, five.session.document.start.mesh.points
    five.refresh()
    assert window.canvas.viewport.overlay_layers.optional["original"].shown
    mesh = window.session.document.now.mesh
    moved = mesh.with_points(mesh.points * 1.2)
    window.session.commands.adopt_positions("grow", State.of(moved))
    five.refresh()
    places = window.canvas.viewport.overlay_layers.optional["original"].places
    np.testing.assert_allclose(np.ptp(places, axis=0), np.ptp(opened, axis=0), rtol=1e-6)
    press_key(five, "original")
    assert not window.canvas.viewport.overlay_layers.optional["original"].shown


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
    press_key(window, "others")
    window.refresh()
    assert not window.canvas.viewport.overlay_layers.optional["others"].shown
    press_key(window, "others")
    window.refresh()
    assert window.canvas.viewport.overlay_layers.optional["others"].shown
    io.write(tmp_path / "plain.exo", bare)
    open_and_know(qtbot, window, tmp_path / "plain.exo")
    assert "next to the hexes" not in window.messages.text.text()
    assert not window.canvas.viewport.overlay_layers.optional["others"].shown
    assert not layer.box.isVisibleTo(window.features["structure"].panel)
