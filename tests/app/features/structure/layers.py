"""Helpers that operate the layers of the structure."""

import numpy as np
from PySide6.QtCore import QPoint
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel

from tests.app.driving import LEFT, open_and_wait, turn
from tests.app.driving import pixels as drawn


def open_and_know(qtbot, window, path):
    """Open a mesh, and wait until its structure is found."""
    open_and_wait(qtbot, window, path)
    qtbot.waitUntil(lambda: window.session.structure_finder.result is not None)
    window.refresh()


def press(box):
    QTest.mouseClick(box, LEFT, pos=QPoint(8, box.height() // 2))


def texts(panel, name):
    """Return the texts of a layer's legend."""
    turn()  # delete the old labels
    return [label.text() for label in panel.layers[name].entries.findChildren(QLabel)]


def pixels(window):
    """Return the pixels of a fast frame, whose edges differ from those of a shaded one."""
    window.refresh()
    window.canvas.viewport.moving()
    return drawn(window)


def count(image, colour):
    return int((image == np.frombuffer(bytes.fromhex(colour[1:]), np.uint8)).all(axis=2).sum())
