"""Keys that rotate, pan and zoom the 3D view."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from PySide6.QtCore import Qt
from PySide6.QtGui import QKeyEvent
from vtkmodules.vtkRenderingCore import vtkCamera

from hexmend_app.scene.camera import steering

#: Steps of a key: rotation in degrees, panning as a fraction of the picture height, and zoom factor.
_TURN, _PAN, _ZOOM = 15.0, 0.1, 1.2

_ARROWS: dict[int, tuple[int, int]] = {
    Qt.Key.Key_Right: (1, 0),
    Qt.Key.Key_Left: (-1, 0),
    Qt.Key.Key_Up: (0, 1),
    Qt.Key.Key_Down: (0, -1),
}
_ZOOMS: dict[int, float] = {Qt.Key.Key_Plus: _ZOOM, Qt.Key.Key_Equal: _ZOOM, Qt.Key.Key_Minus: 1 / _ZOOM}

#: Modifiers of other shortcuts; for example, Alt with an arrow goes back or forward.
_OTHERS = Qt.KeyboardModifier.AltModifier | Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.MetaModifier


def move_of(event: QKeyEvent, up: str) -> Callable[[vtkCamera], None] | None:
    """Return the camera movement of a key, given the vertical axis `up`; None for an unbound key."""
    if event.modifiers() & _OTHERS:
        return None
    if event.key() in _ARROWS:
        right, above = _ARROWS[event.key()]
        if event.modifiers() & Qt.KeyboardModifier.ShiftModifier:
            return partial(steering.pan, right=_PAN * right, up=_PAN * above)
        return partial(steering.turn, right=_TURN * right, up=_TURN * above, axis=up)
    if event.key() in _ZOOMS:
        return partial(steering.zoom, factor=_ZOOMS[event.key()])
    return None
