"""Reset of the window that tests share to its initial state."""

from contextlib import contextmanager

import shiboken6
from PySide6.QtCore import QPoint, QSettings
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QAbstractItemView, QApplication, QScrollBar

from benchmarks.window.windows import end_run
from hexmend import MotionRules, Stage, StoppingCriteria
from hexmend.smoothers import DEFAULT_METHOD, METHODS
from hexmend_app.state.mesh.history import LIMIT
from hexmend_app.state.run.timeline import SPEED
from hexmend_app.state.session import session_data
from hexmend_app.theme import theme_choice
from hexmend_app.widgets.section import Section
from hexmend_app.widgets.view_strip import ViewStrip

SIZE = 1024, 640


class Resetting:
    """Record of the initial state of a window, which is restored by `reset`.

    Parameters
    ----------
    window : Window
        Window in its initial state, with an open mesh.
    path : Path
        File for its session.
    """

    def __init__(self, window, path):
        self.window, self._path = window, path
        self._layout = window.docks.state()
        session_data.write(path, window.session.to_data())
        self._collapsed = [section for section in window.findChildren(Section) if not section.isExpanded()]

    def end(self):
        """Close dialogs and end all tasks."""
        while (popup := QApplication.activePopupWidget()) is not None:
            popup.close()
        for widget in QApplication.topLevelWidgets():
            if widget is not self.window and widget.isVisible():
                widget.close()
        for feature in self.window.features.values():
            feature.close()
        session = self.window.session
        end_run(session)
        session.comparison.cancel()
        session.opener.cancel()

    def reset(self, qtbot):
        """Restore the initial state: the session as from a file, the settings, the layout and the view."""
        self.end()
        window = self.window
        with unseen(window):
            self._reset_session()
            window.canvas.set_parallel(False)
            window.canvas.set_up("z")
            window.showNormal()
            window.resize(*SIZE)
            window.refresh()
            window.messages.clear()
            for strip in window.findChildren(ViewStrip):
                strip.closed.emit()
            if window.docks.state() != self._layout:
                lay_out(window, self._layout)
            for section in self._collapsed:
                section.collapse()
            for view in window.findChildren(QAbstractItemView):
                if view.selectionModel() is not None:
                    view.clearSelection()
            scroll_back(window)
            settle(qtbot, window)
        QApplication.processEvents()

    def _reset_session(self):
        session = self.window.session
        session.node_sweep.leave()
        QSettings().clear()
        theme_choice.apply_theme()
        for method in METHODS.values():  # building a form is slow
            if session.run_setup.values_of(method.name) not in ({}, method().values()):
                session.run_setup.choose(Stage(method(), StoppingCriteria()))
        session.run_setup.choose(Stage(METHODS[DEFAULT_METHOD](), StoppingCriteria()))
        session.run_setup.active_stage = None
        session.run_setup.set_rules(MotionRules())
        session.history.set_limit(LIMIT)
        session.run.show_every(False)
        session.timeline.pause()
        session.timeline.set_speed(SPEED)
        session.view.set_handles(True)
        session.view.set_snap(True)
        session.view.set_rings(1)
        session.restore(session_data.read(self._path))  # new states, which no feature has seen


@contextmanager
def unseen(window):
    """Disable drawing of a window, which would take most of the time of a reset."""
    window.setUpdatesEnabled(False)
    try:
        yield
    finally:
        window.setUpdatesEnabled(True)


def lay_out(window, layout):
    """Restore a layout of the panels."""
    for panel in window.docks.ids():
        window.docks.show_panel(panel)  # restoring closes panels that are closed in the layout
    window.docks.restore(layout)
    QApplication.processEvents()


def scroll_back(window):
    """Scroll everything to its start."""
    QApplication.processEvents()
    for bar in window.findChildren(QScrollBar):
        if shiboken6.isValid(bar):  # moving a scroll bar may delete others
            bar.setValue(bar.minimum())


def settle(qtbot, window):
    """Fit the mesh in a standard view, activate the window and clear the keyboard focus."""
    window.refresh()
    for _ in range(5):  # sizes reach nested widgets one level after the other
        QApplication.processEvents()
    window.canvas.look_along("iso")
    window.canvas.fit()
    window.canvas.camera_animation.restart()
    QTest.mouseMove(window, QPoint(1, 1))
    window.activateWindow()
    window.windowHandle().requestActivate()
    qtbot.waitUntil(window.isActiveWindow)  # otherwise shortcuts have no effect
    if QApplication.focusWidget() is not None:
        QApplication.focusWidget().clearFocus()
    QApplication.processEvents()
