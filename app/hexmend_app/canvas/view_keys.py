"""The keys that turn, shift and enlarge what the 3D view shows."""

from __future__ import annotations

from functools import partial

import pyvista as pv
from PySide6.QtCore import Qt
from PySide6.QtGui import QKeyEvent

from hexmend_app.scene.camera import steering

#: Degrees, share of the picture's height, and factor of one stroke.
_TURN, _PAN, _ZOOM = 15.0, 0.1, 1.2

_ARROWS = {
    Qt.Key.Key_Right: (1, 0),
    Qt.Key.Key_Left: (-1, 0),
    Qt.Key.Key_Up: (0, 1),
    Qt.Key.Key_Down: (0, -1),
}
_ZOOMS = {Qt.Key.Key_Plus: _ZOOM, Qt.Key.Key_Equal: _ZOOM, Qt.Key.Key_Minus: 1 / _ZOOM}


def steer(camera: pv.Camera, event: QKeyEvent) -> bool:
    """Lead the camera as a key says; whether it says anything."""
    if event.key() in _ARROWS:
        right, up = _ARROWS[event.key()]
        shifted = event.modifiers() & Qt.KeyboardModifier.ShiftModifier
        move, step = (steering.pan, _PAN) if shifted else (steering.turn, _TURN)
        move = partial(move, right=step * right, up=step * up)
    elif event.key() in _ZOOMS:
        move = partial(steering.zoom, factor=_ZOOMS[event.key()])
    else:
        return False
    move(camera)
    return True
