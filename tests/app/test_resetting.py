"""Reset of the shared window, whatever the test before has done."""

import numpy as np
import pytest
import shiboken6
from PySide6.QtWidgets import QAbstractButton, QAbstractSlider, QAbstractSpinBox, QComboBox, QLineEdit

from hexmend_app.formats.session.archive import read_archive
from hexmend_app.formats.session.session_file import VERSION
from hexmend_app.picture import Camera, Cut
from hexmend_app.state.run.run_controller import Phase
from hexmend_app.state.session import session_data
from tests.app.driving import click_until

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
        click_until(window, qtbot, "Step", Phase.PAUSED)
    click_until(window, qtbot, "Stop", Phase.FINISHED)
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


def session_of(window, path):
    """Return the data of the session of a window, as in a file."""
    session_data.write(path, window.session.to_data())
    return read_archive(path, "Hexmend session", VERSION)


def rounded(value):
    """Return nested data with rounded numbers, as a camera that was moved and returned differs in its last digits."""
    if isinstance(value, dict):
        return {key: rounded(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [rounded(item) for item in value]
    return round(value, 9) + 0.0 if isinstance(value, float) else value


def test_after_a_reset_the_shared_window_has_the_session_and_layout_of_before(shared, qtbot, tmp_path):
    resetting, path = shared(qtbot), tmp_path / "a.hexmend"
    resetting.reset(qtbot)
    session, layout = session_of(resetting.window, path), resetting.window.docks.state()
    live(resetting.window, qtbot)
    resetting.end()
    resetting.reset(qtbot)
    np.testing.assert_equal(rounded(session_of(resetting.window, path)), rounded(session))
    assert resetting.window.docks.state() == layout
