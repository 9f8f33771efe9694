"""Driving the window as a hand does."""

from __future__ import annotations

from typing import TypeVar

import numpy as np
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QImage, QMouseEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QAbstractButton, QApplication, QCheckBox, QComboBox, QWidget

from hexmend.run import StoppingCriteria
from hexmend.run.recipe import Stage
from hexmend.smoothers import METHODS
from tests.patience import PATIENCE

LEFT = Qt.MouseButton.LeftButton

Part = TypeVar("Part", bound=QWidget)


def open_and_wait(qtbot, window, path):
    with qtbot.waitSignal(window.session.opener.ended, timeout=PATIENCE):
        window.features["open"].open(path)


def click(window, text):
    """Press one of the buttons that hold a run."""
    window.refresh()
    press(
        next(
            b
            for b in window.features["smooth"].panel.findChildren(QAbstractButton)
            if b.accessibleName() == text and b.isVisible()
        )
    )


def press(button: QAbstractButton):
    """Press a button that can be pressed, and let the window show what came of it."""
    button.window().refresh()
    assert button.isEnabled()
    QTest.mouseClick(button, LEFT)
    button.window().refresh()


def tick(box: QCheckBox):
    """Press a check box's mark, and let the window show what came of it."""
    box.window().refresh()
    assert box.isEnabled()
    QTest.mouseClick(box, LEFT, pos=QPoint(8, box.height() // 2))
    box.window().refresh()


def named(parent: QWidget, kind: type[Part], name: str) -> Part:
    """The part below a widget that a screen reader calls by a name."""
    (one,) = (part for part in parent.findChildren(kind) if part.accessibleName() == name)
    return one


def key(window, key, *modifiers):
    """Press a key, and let the window show what came of it."""
    window.refresh()
    held = Qt.KeyboardModifier.NoModifier
    for modifier in modifiers:
        held |= modifier
    QTest.keyClick(window, key, held)
    window.refresh()


def choose(window, method, stop=None, **values):
    """Have a method at hand, with its values and its limits."""
    window.session.run_setup.choose(Stage(METHODS[method](**values), stop or StoppingCriteria()))
    window.refresh()


def choose_by_keys(window, method):
    """Choose a method in its panel, as a hand does, and go back to the view."""
    window.refresh()
    walk_to(window, named(window.features["smooth"].panel, QComboBox, "Method"), method)
    window.canvas.interactor.setFocus()  # or letters would be typed in the list


def walk_to(window, box, data):
    """Walk to an entry of a list by the last of its keys, as a hand does, and let the window show what came of it.

    What is on the way there is not chosen, as in the list that has dropped down.
    """
    window.refresh()
    box.setFocus()
    wanted, last = box.findData(data), box.count() - 1
    if box.currentIndex() != wanted:
        box.blockSignals(True)
        box.setCurrentIndex(wanted + 1 if wanted < last else wanted - 1)
        box.blockSignals(False)
        QTest.keyClick(box, Qt.Key.Key_Up if wanted < last else Qt.Key.Key_Down)
    assert box.currentData() == data
    window.refresh()


def turn():
    """Let Qt do what it puts off to its next turn: lay out, resize, delete."""
    QApplication.processEvents()
    QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    QApplication.processEvents()


def phase(window, phase):
    return lambda: window.session.run.phase is phase


def pixels(window):
    """What the 3D view shows, (h, w, 3)."""
    window.refresh()
    image = window.canvas.interactor.grabFramebuffer().convertToFormat(QImage.Format.Format_RGB888)
    rows = np.frombuffer(image.constBits(), np.uint8).reshape(image.height(), image.bytesPerLine())
    return rows[:, : 3 * image.width()].reshape(image.height(), image.width(), 3).astype(int)


def move(widget, at, held=Qt.MouseButton.NoButton):
    """Move the mouse to a place of a widget, at once: the system's own pointer would come there later."""
    place = QPointF(at)
    spot = QMouseEvent.Type.MouseMove, place, widget.mapToGlobal(place)
    QApplication.sendEvent(widget, QMouseEvent(*spot, Qt.MouseButton.NoButton, held, Qt.KeyboardModifier.NoModifier))
    QApplication.processEvents()


def drag(widget, start, end, steps=5):
    """Press, move and release the mouse as a hand does."""
    move(widget, start)
    QTest.mousePress(widget, LEFT, pos=start)
    for k in range(1, steps + 1):
        move(widget, start + (end - start) * (k / steps), LEFT)
    QTest.mouseRelease(widget, LEFT, pos=end)
    QApplication.processEvents()


def seen_at(window, place):
    """Where in the view a place of the mesh is seen."""
    interactor = window.canvas.interactor
    renderer, ratio = window.canvas.panes.pane.renderer, interactor.devicePixelRatioF()
    renderer.SetWorldPoint(*place, 1)
    renderer.WorldToDisplay()
    right, up, _ = renderer.GetDisplayPoint()
    return QPoint(round(right / ratio), round(interactor.height() - up / ratio))
