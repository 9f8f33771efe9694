"""Layers of the structure in the window, by mouse and keys."""

import numpy as np
import pytest
from PySide6.QtCore import Qt

from hexmend import Mesh, gallery, io
from hexmend_app.features.structure.feature import StructurePanel
from hexmend_app.picture.appearance import Look, Structure
from hexmend_app.picture.layer_switch import EDGE_LAYERS
from hexmend_app.picture.page import Page
from hexmend_app.scene.layers.optional.original_surface import OriginalSurface
from hexmend_app.scene.layers.optional.structure import SHARP, VALENCES
from hexmend_app.state.mesh.document import MeasuredMesh
from hexmend_app.state.mesh.structure import find_structure
from tests.app.driving import heard_from, key, open_and_wait, tick
from tests.app.features.structure.layers import count, pixels, press, texts
from tests.app.state.mesh.test_structure import tetrahedron
from tests.core.curved_shell import curved_shell
from tests.core.grids import displaced, grid


def test_a_key_shows_and_hides_a_layer(five):
    before = pixels(five)
    box = five.features["structure"].panel.layers["irregular"].box
    key(five, Qt.Key.Key_S)
    assert five.session.view.look.structure == Structure.of("irregular")
    assert box.isChecked()
    assert five.window_actions["show_irregular"].isChecked()
    assert (np.abs(pixels(five) - before).sum(axis=2) > 60).sum() > 100
    key(five, Qt.Key.Key_S)
    assert five.session.view.look == Look(page=Page(shading=False))
    np.testing.assert_array_equal(pixels(five), before)


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
    assert texts(opened.features["structure"].panel, "curved") == ["27 hexes"]
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


# Counts and check boxes of the structure panel.


@pytest.fixture
def panel(shown):
    return shown(StructurePanel(), 330)


def test_layers_are_offered_before_their_contents_are_counted(panel):
    assert texts(panel, "irregular") == []
    panel.set_found(None)
    panel.set_classes(None)
    panel.set_nodes(8, 1, 3, 2)
    panel.set_legend("original", OriginalSurface.legend(grid(2)))
    offered = [name for name, on in panel.offered().items() if on]
    assert offered == ["irregular", "boundary", "sharp", "fixed", "free", "locked", "kinds", "original"]
    assert texts(panel, "irregular") == ["counting…"]
    assert texts(panel, "fixed") == ["8 boundary", "1 pinned"]
    assert texts(panel, "locked") == ["of 2 hexes"]


def test_a_failed_classification_is_reported(panel):
    panel.set_classes(None, ValueError("no boundary"))
    assert texts(panel, "kinds") == ["failed"]
    assert not panel.offered()["kinds"]
    assert "Not counted: no boundary." in panel.layers["kinds"].box.toolTip()
    panel.set_classes(None)
    assert texts(panel, "kinds") == ["counting…"]
    assert panel.offered()["kinds"]


def test_edges_are_counted_by_valence(panel):
    panel.set_found(find_structure(tetrahedron()))
    assert texts(panel, "irregular") == ["4 of 3", "1 node"]
    assert "120° or 72°" in panel.layers["irregular"].box.toolTip()
    mesh = grid(8)
    p = mesh.points / 4 - 1
    size = np.maximum(np.linalg.norm(p, axis=1, keepdims=True), 1e-9)
    panel.set_found(find_structure(Mesh(p * np.abs(p).max(axis=1, keepdims=True) / size, mesh.hexes)))
    assert texts(panel, "boundary") == [f"{12 * 8} of 1"]


def test_an_empty_layer_is_disabled_but_can_be_switched_off(panel):
    panel.set_found(find_structure(grid(2)))
    panel.set_nodes(26, 0, 1, 0)
    panel.set_legend("original", OriginalSurface.legend(grid(2)))
    assert panel.offered() == {
        "irregular": False, "boundary": False, "sharp": True, "fixed": True, "free": True, "locked": False,
        "kinds": False, "original": True, "target": False, "interfaces": False,
        "curved": False,
    }  # fmt: skip
    assert texts(panel, "irregular") == ["none"]
    assert "shared by four hexes" in panel.layers["irregular"].box.toolTip()
    heard = heard_from(panel.structure_changed)
    press(panel.layers["irregular"].box)
    assert heard == []
    panel.set_structure(Structure.of("irregular"))
    press(panel.layers["irregular"].box)
    assert heard == [Structure()]
    assert not panel.offered()["irregular"]


# The structure of the open mesh is found in the background.


@pytest.mark.slow
def test_the_structure_of_the_last_opened_mesh_is_found(window, qtbot):
    first, last = MeasuredMesh.of(gallery.make("five-side", size=30_000)), MeasuredMesh.of(grid(2))
    window.session.document.replace(first, None)
    window.session.structure_finder.search()  # not waited for: a small mesh's search may be over between two looks at it
    assert window.session.structure_finder.busy
    window.session.document.replace(last, None)
    qtbot.waitUntil(lambda: window.session.structure_finder.result is not None)
    assert len(window.session.structure_finder.result.sharp) == 24


@pytest.mark.slow
def test_a_layer_stays_on_for_the_next_mesh(five, qtbot, tmp_path):
    key(five, Qt.Key.Key_H)
    key(five, Qt.Key.Key_S)
    io.write(tmp_path / "cube.vtu", grid(3))
    open_and_wait(qtbot, five, tmp_path / "cube.vtu")
    assert five.session.structure_finder.result is None
    five.refresh()
    assert five.canvas.viewport.frame.look.structure.on.isdisjoint(EDGE_LAYERS)  # the view does not wait for them
    qtbot.waitUntil(lambda: five.session.structure_finder.result is not None)
    five.refresh()
    assert five.canvas.viewport.frame.look.structure == Structure.of("irregular", "sharp")
    assert texts(five.features["structure"].panel, "sharp") == ["36"]
    assert five.features["structure"].panel.layers["irregular"].box.isEnabled()  # to be switched off
    assert count(pixels(five), SHARP) > 300
    assert count(pixels(five), VALENCES[5]) == 0
