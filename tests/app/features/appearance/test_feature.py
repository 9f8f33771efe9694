"""Appearance in the window: colours and their ranges."""

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QAbstractButton, QAbstractSpinBox, QComboBox

from tests.app.driving import brought, key, named, pixels, press, walk_to


@pytest.fixture
def panel(window, qtbot):
    """Return the colour panel, in front."""
    return brought(window, qtbot, "look", "appearance")


def differ(before, after):
    """Return the fraction of pixels that differ clearly."""
    return (np.abs(after - before).sum(axis=2) > 60).mean()


@pytest.mark.slow
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
    qtbot.waitUntil(lambda: window.session.document.now is not start)
    window.refresh()
    now = window.session.document.now.figures
    values = now.scaled_jacobian[~now.inverted]
    assert (low.value(), high.value()) == pytest.approx((values.min(), values.max()), abs=0.01)
    press(named(panel, QAbstractButton, "Range: Pinned"))
    assert window.session.view.look.colours.range == (low.value(), high.value())
