"""Appearance in the window: colours, ranges, and when the mesh is redrawn."""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QAbstractButton, QAbstractSpinBox, QComboBox

from hexmend_app.state.mesh.document import State
from tests.app.driving import key, named, pixels, press, walk_to
from tests.patience import PATIENCE


@pytest.fixture
def panel(window):
    """Return the colour panel, in front."""
    window.show_panel("look")
    window.refresh()
    return window.features["appearance"].panel


def differ(before, after):
    """Return the fraction of pixels that differ clearly."""
    return (np.abs(after - before).sum(axis=2) > 60).mean()


def test_the_colours_by_metric_map_and_range(window, qtbot, panel):
    whole, bar = pixels(window), window.canvas.colour_bar
    walk_to(window, named(panel, QComboBox, "Metric"), "scaled-jacobian")
    assert window.session.view.look.colours.metric == "scaled-jacobian"
    assert "Scaled Jacobian from 0 to 1" in bar.accessibleDescription()
    recoloured = pixels(window)
    assert differ(whole, recoloured) > 0.05
    maps = named(panel, QComboBox, "Colour map")
    maps.setFocus()
    QTest.keyClick(maps, Qt.Key.Key_Down)
    assert differ(recoloured, pixels(window)) > 0.05
    low, high = (named(panel, QAbstractSpinBox, f"{end} value") for end in ("Minimum", "Maximum"))
    press(named(panel, QAbstractButton, "Range: Fitted"))
    assert f"from {low.value():g} to {high.value():g}" in bar.accessibleDescription()
    assert not low.isEnabled()
    start = window.session.document.now
    key(window, Qt.Key.Key_F10)
    qtbot.waitUntil(lambda: window.session.document.now is not start, timeout=PATIENCE)
    window.refresh()
    now = window.session.document.now.figures
    values = now.scaled_jacobian[~now.inverted]
    assert (low.value(), high.value()) == pytest.approx((values.min(), values.max()), abs=0.01)
    press(named(panel, QAbstractButton, "Range: Pinned"))
    assert window.session.view.look.colours.range == (low.value(), high.value())


@pytest.mark.slow
def test_faces_within_a_range_are_rebuilt_only_if_they_change(window, monkeypatch):
    viewport, now = window.canvas.viewport, window.session.document.now
    rebuilt = []
    rebuild = viewport.mesh_layer.rebuild
    monkeypatch.setattr(viewport.mesh_layer, "rebuild", lambda *arguments: (rebuilt.append(1), rebuild(*arguments)))
    window.session.view.change(show={"quality": (0.4, 1)})
    window.refresh()
    moved = State.of(now.mesh.with_points(now.mesh.points * 1.01))  # of the same shape
    window.session.document.preview(moved)
    window.refresh()
    assert len(rebuilt) == 1
    np.testing.assert_allclose(
        viewport.mesh_layer.whole.points, viewport.mesh_layer.faces.places(moved.mesh.points), rtol=1e-6
    )
    shaken = now.mesh.points + 0.3 * now.mesh.mean_edge_length * np.random.default_rng(0).random(now.mesh.points.shape)
    window.session.document.preview(State.of(now.mesh.with_points(shaken)))
    window.refresh()
    assert len(rebuilt) == 2
    figures = window.session.document.now.figures
    assert viewport.shown == np.count_nonzero((figures.q >= 0.4) & ~figures.inverted)


@pytest.mark.slow
def test_the_mesh_is_drawn_once_for_all_changes_of_one_turn(window, qtbot, monkeypatch):
    drawn, draw = [], window.canvas.draw
    monkeypatch.setattr(window.canvas, "draw", lambda *arguments: (drawn.append(1), draw(*arguments)))
    for edges in (False, True, False):
        window.session.view.change(lines={"edges": None if edges else 0.0})
    assert drawn == []
    qtbot.waitUntil(lambda: len(drawn) > 0, timeout=PATIENCE)
    window.refresh()
    assert len(drawn) == 1
