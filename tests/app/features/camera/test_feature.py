"""Copying and pasting the camera."""

from __future__ import annotations

import pytest
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


def test_a_direction_is_pasted_too(window):
    QGuiApplication.clipboard().setText('{ from = "-y", up = "x", parallel = true }')
    window.action("paste_camera").trigger()
    pose = window.canvas.pose
    assert (pose.axis, pose.parallel) == ("x", True)
    away = [a - b for a, b in zip(pose.position, pose.focal, strict=True)]
    assert away[1] < 0
    assert (away[0], away[2]) == pytest.approx((0, 0), abs=1e-9 * abs(away[1]))


@pytest.mark.parametrize("text", ["", "some words", "{ from = 'up' }", "{ position = [nan, 0, 0] }"])
def test_pasting_other_text_shows_an_error_and_changes_nothing(window, text):
    stand = window.canvas.pose
    QGuiApplication.clipboard().setText(text)
    window.action("paste_camera").trigger()
    assert window.messages.messages()[-1][:2] == ("error", "Camera not pasted")
    assert window.canvas.pose == stand
