"""The panel Inside by mouse and keys, and its effect in the window."""

import numpy as np
import pytest
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QPushButton, QSpinBox

from hexmend import gallery
from hexmend_app.features.cut.inside_panel import InsidePanel
from hexmend_app.picture import Cut, Isolate, Show
from hexmend_app.picture.appearance import Look
from tests.app.driving import LEFT, heard_from, named, open_mesh, type_text

PEEL, RINGS = "Peel layers", "Rings around isolated hexes"
BUTTONS = ("Show all", "Show last", "Show hidden")


@pytest.fixture
def panel(shown):
    panel = InsidePanel()
    panel.set_layers(4)
    return shown(panel, 330)


@pytest.fixture
def window(window, qtbot, tmp_path):
    """Return the window with an inverted mesh of several layers."""
    open_mesh(qtbot, window, tmp_path / "cube.vtu", gallery.make("cube", size=1000, scramble=0.3, seed=1))
    return window


def faces(window):
    """Return the hexes of the drawn faces."""
    window.refresh()
    return window.canvas.viewport.mesh_layer.faces.hexes


def type_into(box, text):
    box.setFocus()
    type_text(box, text, enter=True)


# The panel


def test_layers_are_typed_and_those_of_a_look_are_shown_without_a_signal(panel):
    emitted = heard_from(panel.peel.valueChanged)
    type_into(named(panel, QSpinBox, PEEL), "3")
    panel.set_look(Look(show=Show(peel=2)), 1)
    assert named(panel, QSpinBox, PEEL).value() == 2
    assert set(emitted) == {3}


def test_peeling_is_disabled_if_all_hexes_are_on_the_boundary(panel):
    panel.set_layers(0)
    assert not named(panel, QSpinBox, PEEL).isEnabled()
    assert "every hex has a face on the boundary" in named(panel, QSpinBox, PEEL).toolTip()
    panel.set_layers(2)
    assert named(panel, QSpinBox, PEEL).isEnabled()
    assert "Hide the outer layers" in named(panel, QSpinBox, PEEL).toolTip()


def test_buttons_are_enabled_if_hexes_are_isolated_or_dug_away(panel):
    buttons = [named(panel, QPushButton, name) for name in BUTTONS]
    assert not any(button.isEnabled() for button in buttons)
    panel.set_look(Look(show=Show(isolate=Isolate((4,), 2), hidden=frozenset({1, 2, 3}))), 2)
    assert all(button.isEnabled() for button in buttons)
    assert named(panel, QSpinBox, RINGS).value() == 2
    assert panel.isolated.text() == "1 hex isolated"
    assert panel.dug.text() == "3 hexes hidden"
    emitted = []
    panel.all_button.clicked.connect(lambda: emitted.append("all"))
    panel.undo_button.clicked.connect(lambda: emitted.append("undo"))
    panel.restore_button.clicked.connect(lambda: emitted.append("restore"))
    for button in buttons:
        QTest.mouseClick(button, LEFT)
    assert emitted == ["all", "undo", "restore"]


# The window


def test_everything_combines(window):
    view = window.session.view
    mesh, figures = window.session.document.now.mesh, window.session.document.now.quality
    clip = Cut.at((1, 0, 0), tuple(mesh.points.mean(axis=0)))
    patch = mesh.topology.hexes_around([444], 3)
    view.isolate(np.flatnonzero(patch), 1)  # restores hexes that peeling would hide
    view.change(cut=clip, show={"peel": 1, "quality": (0.2, 0.9)})
    view.dig(443)
    expected = clip.planes[0].signed_distance(mesh.points[mesh.hexes].mean(axis=1)) <= 0
    expected &= mesh.topology.layers >= 1
    expected &= (figures.q >= 0.2) & (figures.q <= 0.9)
    expected &= patch
    expected[443] = False
    assert 0 < expected.sum() < 200
    window.refresh()
    assert window.canvas.viewport.shown == expected.sum()
    view.change(show={"shrink": 0.3})
    np.testing.assert_array_equal(
        np.unique(faces(window), return_counts=True), [expected.nonzero()[0], [6] * expected.sum()]
    )


@pytest.mark.slow
def test_in_large_meshes_only_visible_hexes_are_shrunk(window, monkeypatch):
    monkeypatch.setattr("hexmend_app.scene.geometry.skin.WHOLE", 500)
    window.session.view.change(show={"shrink": 0.3})
    layers = window.session.document.now.mesh.topology.layers
    assert set(faces(window)) == set(np.flatnonzero(layers == 0))
    assert len(faces(window)) == 6 * np.count_nonzero(layers == 0)
    window.session.view.change(show={"peel": 2})
    assert set(faces(window)) <= set(np.flatnonzero(layers >= 2))
