"""Simulated user input: mouse, keys and choices in the window."""

from typing import TypeVar

import numpy as np
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import QImage, QMouseEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QAbstractButton, QApplication, QCheckBox, QComboBox, QLabel, QWidget

from hexmend import METHODS, Stage, StoppingCriteria, io
from hexmend_app.picture import Page
from hexmend_app.state.run.run_controller import Phase

LEFT = Qt.MouseButton.LeftButton

Part = TypeVar("Part", bound=QWidget)


def open_and_wait(qtbot, window, path):
    with qtbot.waitSignal(window.session.opener.ended):
        window.features["open"].open(path)


def open_mesh(qtbot, window, path, mesh):
    """Write a mesh to a file, and open it."""
    io.write(path, mesh)
    open_and_wait(qtbot, window, path)
    window.refresh()


def smooth(qtbot, session, method="laplacian", iterations=3, **values):
    """Run a method for a number of iterations."""
    stage = Stage(METHODS[method](**values), StoppingCriteria(max_iterations=iterations, tolerance=0))
    with qtbot.waitSignal(session.run.ended):
        session.commands.run(stage)


def run_to_end(window, qtbot, method, **stop):
    """Choose a method with stopping criteria, run it by its button, and wait for its end."""
    choose(window, method, StoppingCriteria(**stop))
    click(window, "Run")
    qtbot.waitUntil(phase(window, Phase.FINISHED))
    window.refresh()


def brought(window, qtbot, panel, feature=""):
    """Bring a panel to the front, and return it."""
    window.show_panel(panel)
    widget = window.features[feature or panel].panel
    qtbot.waitUntil(widget.isVisible)
    window.refresh()
    return widget


def click(window, text):
    """Press a button of the active run below the view, or of the smoothing panel."""
    window.refresh()
    press(
        next(
            b
            for part in (window.features["timeline"].panel.run_bar, window.features["smooth"].panel)
            for b in part.findChildren(QAbstractButton)
            if b.accessibleName() == text and b.isVisible()
        )
    )


def click_until(window, qtbot, text, awaited):
    """Press a button of the smoothing panel, and wait for a phase of the run."""
    click(window, text)
    qtbot.waitUntil(phase(window, awaited))


def press(button: QAbstractButton):
    """Press an enabled button and refresh the window."""
    button.window().refresh()
    assert button.isEnabled()
    QTest.mouseClick(button, LEFT)
    button.window().refresh()


def button(parent: QWidget, text: str) -> QAbstractButton:
    """Return the visible button with a text."""
    return next(one for one in parent.findChildren(QAbstractButton) if one.text() == text and one.isVisible())


def type_text(line, text: str, enter: bool = False):
    """Type over the text of a line."""
    line.selectAll()
    QTest.keyClicks(line, text)
    if enter:
        QTest.keyClick(line, Qt.Key.Key_Return)


def heard_from(signal) -> list:
    """Return a list of what a signal sends from now on."""
    heard = []
    signal.connect(heard.append)
    return heard


def texts(parent: QWidget) -> list[str]:
    """Return the texts of the visible labels."""
    return [label.text() for label in parent.findChildren(QLabel) if label.isVisible()]


def tick(box: QCheckBox):
    """Click the mark of a check box and refresh the window."""
    box.window().refresh()
    assert box.isEnabled()
    QTest.mouseClick(box, LEFT, pos=QPoint(8, box.height() // 2))
    box.window().refresh()


def named(parent: QWidget, kind: type[Part], name: str) -> Part:
    """Return the only child widget of a type with an accessible name; the visible one where Qt keeps others for later."""
    parts = [part for part in parent.findChildren(kind) if part.accessibleName() == name]
    (widget,) = parts if len(parts) == 1 else [part for part in parts if part.isVisible()]
    return widget


def key(window, key, *modifiers):
    """Press a key and refresh the window."""
    window.refresh()
    pressed = Qt.KeyboardModifier.NoModifier
    for modifier in modifiers:
        pressed |= modifier
    QTest.keyClick(window, key, pressed)
    window.refresh()


def choose(window, method, stop=None, **values):
    """Choose a method with parameters and stopping criteria."""
    window.session.run_setup.choose(Stage(METHODS[method](**values), stop or StoppingCriteria()))
    window.refresh()


def choose_by_keys(window, method):
    """Choose a method in its panel by keys, and return the focus to the view."""
    window.refresh()
    walk_to(window, named(window.features["smooth"].panel, QComboBox, "Method"), method)
    window.canvas.interactor.setFocus()  # otherwise letters would be typed in the list


def walk_to(window, box, data):
    """Choose an entry of a combo box by an arrow key and refresh the window.

    Entries on the way are not chosen, as in the open list.
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
    """Process events of Qt, including deferred layouts, resizing and deletions."""
    QApplication.processEvents()
    QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    QApplication.processEvents()


def phase(window, phase):
    return lambda: window.session.run.phase is phase


def pixels(window):
    """Return the pixels of the 3D view, (h, w, 3)."""
    window.refresh()
    image = window.canvas.interactor.grabFramebuffer().convertToFormat(QImage.Format.Format_RGB888)
    rows = np.frombuffer(image.constBits(), np.uint8).reshape(image.height(), image.bytesPerLine())
    return rows[:, : 3 * image.width()].reshape(image.height(), image.width(), 3).astype(int)


def move(widget, at, buttons=Qt.MouseButton.NoButton):
    """Send a mouse move at once; the pointer of the system would arrive later."""
    place = QPointF(at)
    spot = QMouseEvent.Type.MouseMove, place, widget.mapToGlobal(place)
    QApplication.sendEvent(widget, QMouseEvent(*spot, Qt.MouseButton.NoButton, buttons, Qt.KeyboardModifier.NoModifier))
    QApplication.processEvents()


def drag(widget, start, end, steps=5):
    """Press, move and release the mouse."""
    move(widget, start)
    QTest.mousePress(widget, LEFT, pos=start)
    for k in range(1, steps + 1):
        move(widget, start + (end - start) * (k / steps), LEFT)
    QTest.mouseRelease(widget, LEFT, pos=end)
    QApplication.processEvents()


def seen_at(window, place):
    """Return the position in the view, in pixels, of a point of the mesh."""
    interactor = window.canvas.interactor
    renderer, ratio = window.canvas.panes.pane.renderer, interactor.devicePixelRatioF()
    renderer.SetWorldPoint(*place, 1)
    renderer.WorldToDisplay()
    right, up, _ = renderer.GetDisplayPoint()
    return QPoint(round(right / ratio), round(interactor.height() - up / ratio))


def sentence(window):
    """Return the sentence below the buttons of the run."""
    window.refresh()
    return named(window.features["smooth"].panel, QLabel, "Outcome").text()


def write_picture(window, path, size):
    """Write the view as a picture of a size; return True if it was written."""
    scene = window.canvas.scene(Page(pixels=size), window.session.saved_cameras.all)
    return window.features["export"].write_picture(path, scene)
