"""Copying and pasting the camera."""

from __future__ import annotations

from PySide6.QtGui import QGuiApplication

from hexmend_app.picture import camera_from


def test_a_copied_camera_is_pasted_unchanged(window):
    canvas = window.canvas
    canvas.roll(20)
    window.action("parallel").trigger()
    pose = canvas.pose
    window.action("copy_camera").trigger()
    assert camera_from(QGuiApplication.clipboard().text()).pose == pose
    canvas.look_along("+x")
    window.action("parallel").trigger()
    assert canvas.pose != pose
    window.action("paste_camera").trigger()
    assert canvas.pose == pose
