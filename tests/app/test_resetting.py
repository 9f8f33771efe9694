"""The window that tests share is as if it were new, whatever the test before has done."""

from __future__ import annotations

import numpy as np
import pytest
import shiboken6
from PySide6.QtWidgets import QAbstractButton, QAbstractSlider, QAbstractSpinBox, QComboBox, QLineEdit

from hexmend_app.picture import Camera
from hexmend_app.picture.cut_planes import PlaneClip
from hexmend_app.state.run.run_controller import Phase
from tests.app.driving import click, phase
from tests.app.picturing import everything
from tests.patience import PATIENCE

pytestmark = pytest.mark.slow


def fiddle(window):
    """Set everything that a hand can set to something else."""

    def offered(kind):
        for one in window.findChildren(kind):  # some go, and others come, by what is done to those before
            if shiboken6.isValid(one) and one.isVisible() and one.isEnabled():
                yield one

    for widget in offered(QComboBox):
        if widget.count() > 1:
            widget.setCurrentIndex((widget.currentIndex() + 1) % widget.count())
            widget.activated.emit(widget.currentIndex())
    for widget in offered(QAbstractButton):
        if widget.isCheckable():
            widget.click()
    for widget in offered(QAbstractSlider):
        third = (widget.minimum() + widget.maximum()) // 3
        widget.setValue(third if isinstance(widget.value(), int) else (third, third + 1))
    for widget in offered(QAbstractSpinBox):
        widget.stepUp()
    for widget in offered(QLineEdit):
        if not isinstance(widget.parentWidget(), QAbstractSpinBox):
            widget.setText("7")
            widget.textEdited.emit("7")
            widget.editingFinished.emit()


def live(window, qtbot):
    """An eventful session."""
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
    session.view.set_clip(PlaneClip.at((1, 0, 0), middle))
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
    """All of a window, once what is found beside it is known; its script goes on with every mesh that is opened."""
    qtbot.waitUntil(lambda: window.session.structure_finder.structure is not None, timeout=PATIENCE)
    window.refresh()
    return {line for line in everything(window) if "/ScriptPanel/" not in line}


def test_after_an_eventful_session_the_shared_window_is_as_a_new_one(fresh_window, shared, qtbot):
    new = known(fresh_window, qtbot)
    resetting = shared(qtbot)
    resetting.reset(qtbot)
    live(resetting.window, qtbot)
    resetting.end()
    resetting.reset(qtbot)
    now = known(resetting.window, qtbot)
    assert sorted(now - new) == []
    assert sorted(new - now) == []
