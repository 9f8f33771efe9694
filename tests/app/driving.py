"""Driving the window as a hand does."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QPushButton

from tests.patience import PATIENCE

LEFT = Qt.MouseButton.LeftButton


def open_and_wait(qtbot, window, path):
    with qtbot.waitSignal(window.session.opener.ended, timeout=PATIENCE):
        window.features["open"].open(path)


def click(window, text):
    button = next(
        b
        for b in window.features["smooth"].panel.findChildren(QPushButton)
        if b.accessibleName() == text and b.isVisible()
    )
    assert button.isEnabled()
    QTest.mouseClick(button, LEFT)


def phase(window, phase):
    return lambda: window.session.smoothing.phase is phase


def pixels(window):
    """What the 3D view shows, (h, w, 3)."""
    window.canvas.interactor.render()
    return np.asarray(window.canvas.interactor.screenshot(return_img=True)).astype(int)


def drag(widget, start, end, steps=12):
    """Press, move and release the mouse as a hand does."""
    QTest.mouseMove(widget, start)
    QTest.qWait(30)
    QTest.mousePress(widget, LEFT, pos=start)
    for k in range(1, steps + 1):
        QTest.mouseMove(widget, start + (end - start) * (k / steps))
        QTest.qWait(10)
    QTest.mouseRelease(widget, LEFT, pos=end)
    QTest.qWait(50)


def seen_at(window, place):
    """Where in the view a place of the mesh is seen."""
    interactor = window.canvas.interactor
    renderer, ratio = interactor.renderer, interactor.devicePixelRatioF()
    renderer.SetWorldPoint(*place, 1)
    renderer.WorldToDisplay()
    right, up, _ = renderer.GetDisplayPoint()
    return QPoint(round(right / ratio), round(interactor.height() - up / ratio))
