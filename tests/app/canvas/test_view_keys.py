"""Keys that move the camera."""

import numpy as np
import pytest
from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QKeyEvent
from vtkmodules.vtkRenderingCore import vtkCamera

from hexmend_app.canvas.view_keys import move_of
from hexmend_app.scene.camera.directions import UPS, look_from

PLAIN, SHIFT, ALT = (
    Qt.KeyboardModifier.NoModifier,
    Qt.KeyboardModifier.ShiftModifier,
    Qt.KeyboardModifier.AltModifier,
)


def pressed(key, held=PLAIN):
    return QKeyEvent(QEvent.Type.KeyPress, key, held)


@pytest.mark.parametrize("up", UPS)
def test_arrows_rotate_about_the_vertical_axis_and_pan_with_shift(up):
    camera = vtkCamera()
    look_from(camera, "iso", up)
    axis, before = np.array(UPS[up][0]), np.array(camera.GetPosition())
    move_of(pressed(Qt.Key.Key_Right), up)(camera)
    assert not np.allclose(camera.GetPosition(), before)
    assert np.array(camera.GetPosition()) @ axis == pytest.approx(before @ axis)
    assert camera.GetFocalPoint() == (0, 0, 0)
    move_of(pressed(Qt.Key.Key_Right, SHIFT), up)(camera)
    assert camera.GetFocalPoint() != (0, 0, 0)


def test_plus_and_minus_zoom_and_undo_each_other():
    camera = vtkCamera()
    far = camera.GetDistance()
    move_of(pressed(Qt.Key.Key_Plus), "z")(camera)
    assert camera.GetDistance() < far
    move_of(pressed(Qt.Key.Key_Minus), "z")(camera)
    assert camera.GetDistance() == pytest.approx(far)


@pytest.mark.parametrize("event", [(Qt.Key.Key_N,), (Qt.Key.Key_Left, ALT), (Qt.Key.Key_Shift, SHIFT)])
def test_other_keys_are_not_bound(event):
    assert move_of(pressed(*event), "z") is None
