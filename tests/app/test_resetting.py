"""Reset of the shared window: it equals a new window, whatever the test before has done."""

from __future__ import annotations

import numpy as np
import pytest
import shiboken6
from PySide6.QtWidgets import QAbstractButton, QAbstractSlider, QAbstractSpinBox, QComboBox, QLineEdit

from hexmend_app.picture import Camera
from hexmend_app.picture.cut import Cut
from hexmend_app.state.run.run_controller import Phase
from tests.app.driving import click, phase
from tests.app.picturing import everything
from tests.patience import PATIENCE

pytestmark = pytest.mark.slow


def fiddle(window):
    """Change the value of every input widget."""

    def enabled(kind):
        for widget in window.findChildren(kind):  # input may delete widgets and create others
            if shiboken6.isValid(widget) and widget.isVisible() and widget.isEnabled():
                yield widget

    for widget in enabled(QComboBox):
        if widget.count() > 1:
            widget.setCurrentIndex((widget.currentIndex() + 1) % widget.count())
            widget.activated.emit(widget.currentIndex())
    for widget in enabled(QAbstractButton):
        if widget.isCheckable():
            widget.click()
    for widget in enabled(QAbstractSlider):
        third = (widget.minimum() + widget.maximum()) // 3
        widget.setValue(third if isinstance(widget.value(), int) else (third, third + 1))
    for widget in enabled(QAbstractSpinBox):
        widget.stepUp()
    for widget in enabled(QLineEdit):
        if not isinstance(widget.parentWidget(), QAbstractSpinBox):
            widget.setText("7")
            widget.textEdited.emit("7")
            widget.editingFinished.emit()


def live(window, qtbot):
    """Change as much of a session and its window as possible."""
    session = window.session
    middle = tuple(session.document.now.mesh.points.mean(axis=0))
    for _ in range(2):
        click(window, "Step")
        qtbot.waitUntil(phase(window, Phase.PAUSED), timeout=PATIENCE)
    click(window, "Stop")
    qtbot.waitUntil(phase(window, Phase.FINISHED), timeout=PATIENCE)
    session.commands.tag("bad", [7])
    session.commands.pin(int(np.flatnonzero(session.document.now.mesh.free)[50]), True)
    session.selection.choose(7)
    session.view.set_cut(Cut.at((1, 0, 0), middle))
    session.view.isolate([7], 1)
    session.snapshots.add("kept", session.document.now)
    session.saved_cameras.add("kept", Camera("+y"))
    session.side_views.show("start", session.document.start)
    window.messages.show_error("Something is wrong", "And that is what it is.")
    for panel in window.docks.ids():
        window.show_panel(panel)
        window.refresh()
        fiddle(window)
    for action in window.window_actions.values():
        if action.isCheckable() and action.isEnabled():
            action.trigger()
    window.canvas.look_along("+x")
    window.resize(1000, 700)
    window.refresh()


def known(window, qtbot):
    """Return the description of a window, without its script, the doctor's progress and recent files: not reset."""
    qtbot.waitUntil(lambda: window.session.structure_finder.structure is not None, timeout=PATIENCE)
    window.refresh()
    lines = (line for line in everything(window) if not line.startswith("settings"))
    return {line for line in lines if "/ScriptPanel/" not in line and "/DoctorPanel/" not in line}


def test_after_a_reset_the_shared_window_equals_a_new_one(fresh_window, shared, qtbot):
    new = known(fresh_window, qtbot)
    resetting = shared(qtbot)
    resetting.reset(qtbot)
    live(resetting.window, qtbot)
    resetting.end()
    resetting.reset(qtbot)
    now = known(resetting.window, qtbot)
    assert sorted(now - new) == []
    assert sorted(new - now) == []
