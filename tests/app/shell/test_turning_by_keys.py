"""The view rotated, panned and zoomed by keys."""

from __future__ import annotations

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest

from tests.app.driving import pixels

pytestmark = pytest.mark.slow

SHIFT = Qt.KeyboardModifier.ShiftModifier


def direction(camera):
    return np.array(camera.GetDirectionOfProjection())


def test_arrow_keys_turn_the_mesh_by_fifteen_degrees(window):
    view, camera = window.canvas.interactor, window.canvas.viewport.camera
    view.setFocus()
    QTest.keyClick(view, Qt.Key.Key_1)
    first = direction(camera)
    QTest.keyClick(view, Qt.Key.Key_Right)
    assert np.degrees(np.arccos(direction(camera) @ first)) == pytest.approx(15)
    QTest.keyClick(view, Qt.Key.Key_Left)
    np.testing.assert_allclose(direction(camera), first, atol=1e-9)
    QTest.keyClick(view, Qt.Key.Key_Up)
    assert np.degrees(np.arccos(direction(camera) @ first)) == pytest.approx(15)
    for _ in range(23):  # over both poles
        QTest.keyClick(view, Qt.Key.Key_Up)
    np.testing.assert_allclose(direction(camera), first, atol=1e-6)


def shown_at(window):
    """Return the centre of the mesh in the picture, and its number of pixels."""
    image = pixels(window)
    mask = image.max(axis=2) - image.min(axis=2) > 60
    rows, columns = np.nonzero(mask)
    return columns.mean(), rows.mean(), mask.sum()


@pytest.mark.parametrize("parallel", [False, True], ids=["perspective", "parallel"])
def test_keys_pan_and_zoom(window, parallel):
    view = window.canvas.interactor
    if parallel:
        QTest.keyClick(view, Qt.Key.Key_P)
    height = pixels(window).shape[0]
    x, y, area = shown_at(window)
    QTest.keyClick(view, Qt.Key.Key_Minus)
    assert shown_at(window)[2] == pytest.approx(area / 1.44, rel=0.15)
    QTest.keyClick(view, Qt.Key.Key_Plus)
    assert shown_at(window)[2] == pytest.approx(area, rel=0.05)
    for _ in range(3):  # room to move in
        QTest.keyClick(view, Qt.Key.Key_Minus)
    x, y, _ = shown_at(window)
    QTest.keyClick(view, Qt.Key.Key_Right, SHIFT)
    assert shown_at(window)[0] - x == pytest.approx(0.1 * height, rel=0.2)
    QTest.keyClick(view, Qt.Key.Key_Up, SHIFT)
    assert y - shown_at(window)[1] == pytest.approx(0.1 * height, rel=0.2)


def test_keys_of_vtk_do_nothing(window):
    view = window.canvas.interactor
    view.setFocus()
    before = pixels(window)
    for typed in "wsrquj":
        QTest.keyClicks(view, typed)
    assert (np.abs(pixels(window) - before).sum(axis=2) > 60).mean() < 0.01
    assert window.isVisible()
