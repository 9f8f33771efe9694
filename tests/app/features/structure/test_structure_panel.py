"""Counts and check boxes of the structure panel."""

from __future__ import annotations

import numpy as np
import pytest

from hexmend.mesh.mesh import Mesh
from hexmend_app.features.structure.structure_panel import StructurePanel
from hexmend_app.picture.appearance import Structure
from hexmend_app.scene.layers.optional.original_surface import OriginalSurface
from hexmend_app.shell.start.program import application
from hexmend_app.state.mesh.structure import find_structure
from tests.app.features.structure.layers import press, texts
from tests.app.state.mesh.test_structure import tetrahedron
from tests.core.grids import grid
from tests.patience import PATIENCE


@pytest.fixture
def panel(qtbot):
    application()
    panel = StructurePanel()
    qtbot.addWidget(panel)
    panel.resize(330, panel.sizeHint().height())
    with qtbot.waitExposed(panel, timeout=PATIENCE):
        panel.show()
    return panel


def test_only_layers_of_nodes_are_enabled_before_the_edges_are_found(panel):
    assert texts(panel, "irregular") == []
    panel.set_found(None)
    panel.set_classes(None)
    panel.set_nodes(8, 1, 3, 2)
    panel.set_legend("original", OriginalSurface.legend(grid(2)))
    offered = [name for name, on in panel.offered().items() if on]
    assert offered == ["fixed", "free", "locked", "kinds", "original"]
    assert texts(panel, "irregular") == ["counting…"]
    assert "Counting." in panel.layers["sharp"].box.toolTip()
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


def test_curved_faces_are_offered_for_hexes_with_mid_nodes_alone(panel):
    panel.set_curved(None)
    assert not panel.layers["curved"].box.isVisible()
    assert not panel.offered()["curved"]
    mid_nodes = np.full((5, 19), -1)
    mid_nodes[:3, :12] = 8
    panel.set_curved(mid_nodes)
    assert panel.layers["curved"].box.isVisible()
    assert panel.layers["curved"].box.isChecked()
    assert texts(panel, "curved") == ["3 hexes"]
    heard = []
    panel.structure_changed.connect(heard.append)
    press(panel.layers["curved"].box)
    assert heard == [Structure().without("curved")]


def test_an_empty_layer_is_disabled_but_can_be_switched_off(panel):
    panel.set_found(find_structure(grid(2)))
    panel.set_nodes(26, 0, 1, 0)
    panel.set_legend("original", OriginalSurface.legend(grid(2)))
    assert panel.offered() == {
        "irregular": False, "boundary": False, "sharp": True, "fixed": True, "free": True, "locked": False,
        "kinds": False, "others": False, "original": True, "target": False, "interfaces": False,
        "curved": False,
    }  # fmt: skip
    assert texts(panel, "irregular") == ["none"]
    assert "shared by four hexes" in panel.layers["irregular"].box.toolTip()
    heard = []
    panel.structure_changed.connect(heard.append)
    press(panel.layers["irregular"].box)
    assert heard == []
    panel.set_structure(Structure.of("irregular"))
    press(panel.layers["irregular"].box)
    assert heard == [Structure()]
    assert not panel.offered()["irregular"]
