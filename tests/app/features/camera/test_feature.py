"""The camera as text, from one window to another."""

from __future__ import annotations

import pytest
from PySide6.QtGui import QGuiApplication

from hexmend_app.picture import camera_from


def test_a_camera_that_is_copied_is_pasted_as_it_was(window):
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
def test_what_is_no_camera_is_said_and_changes_nothing(window, text):
    pose = window.canvas.pose
    QGuiApplication.clipboard().setText(text)
    window.action("paste_camera").trigger()
    assert window.messages.messages()[-1][:2] == ("error", "The camera cannot be pasted")
    assert window.canvas.pose == pose
