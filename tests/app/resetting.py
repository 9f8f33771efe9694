"""Reset of the window that tests share to its initial state."""

from __future__ import annotations

from contextlib import contextmanager
from weakref import WeakKeyDictionary

import shiboken6
from PySide6.QtCore import QPoint, QSettings
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QAbstractButton,
    QAbstractItemView,
    QAbstractSlider,
    QAbstractSpinBox,
    QApplication,
    QComboBox,
    QLineEdit,
    QScrollBar,
    QTabBar,
    QWidget,
)

from benchmarks.window.windows import end_run
from hexmend.mesh.rules import MotionRules
from hexmend.run import StoppingCriteria
from hexmend.run.recipe import Stage
from hexmend.smoothers import DEFAULT_METHOD, METHODS
from hexmend_app.picture.appearance import Look
from hexmend_app.picture.named_cameras import NamedCameras
from hexmend_app.state.mesh.history import LIMIT
from hexmend_app.state.run.pace import Pace
from hexmend_app.state.run.timeline import SPEED
from hexmend_app.theme import theme_choice
from tests.app.driving import open_and_wait
from tests.patience import PATIENCE

SIZE = 1400, 900


class Resetting:
    """Record of the initial state of a window, which is restored by `reset`.

    Parameters
    ----------
    window : Window
        Window in its initial state, with an open mesh.
    path : Path
        File of the mesh.
    """

    def __init__(self, window, path):
        self.window, self.path = window, path
        self._layout = window.docks.state()
        self._inputs: WeakKeyDictionary[QWidget, object] = WeakKeyDictionary()
        for widget in window.findChildren(QWidget):
            setting = setting_of(widget)
            if setting is not None:
                self._inputs[widget] = setting

    def end(self):
        """Close dialogs and end all tasks."""
        _close_others(self.window)
        for feature in self.window.features.values():
            feature.close()
        session = self.window.session
        end_run(session)
        session.comparison.cancel()
        session.opener.cancel()

    def reset(self, qtbot):
        """Restore the initial state and reopen the mesh."""
        self.end()
        with unseen(self.window):
            self._reset_session()
            self._reopen(qtbot)
            settle(qtbot, self.window)
        QApplication.processEvents()

    def _reset_session(self):
        """Restore the part of the state that does not depend on the mesh."""
        session = self.window.session
        session.node_sweep.leave()
        QSettings().clear()
        theme_choice.apply_theme()
        self._restore_inputs()
        for method in METHODS.values():  # building a form is slow
            if session.run_setup.values_of(method.name) not in ({}, method().values()):
                session.run_setup.choose(Stage(method(), StoppingCriteria()))
        session.run_setup.choose(Stage(METHODS[DEFAULT_METHOD](), StoppingCriteria()))
        session.run_setup.active_stage = None
        session.run_setup.set_rules(MotionRules())
        while session.recipe_draft.stages:
            session.recipe_draft.remove(0)
        session.recipe_draft.rename("")
        session.history.limit = LIMIT
        session.run.set_pace(Pace.FASTEST)
        session.timeline.pause()
        session.timeline.set_speed(SPEED)
        session.side_views.close_all()
        session.saved_cameras.restore(NamedCameras())
        session.view.change(**{name: getattr(Look(), name) for name in Look.__dataclass_fields__})
        session.view.set_handles(True)
        session.view.set_snap(True)
        session.view.set_rings(1)

    def _reopen(self, qtbot):
        """Reopen the mesh, and restore the layout of the window."""
        window = self.window
        window.canvas.set_parallel(False)
        window.canvas.set_up("z")
        window.showNormal()
        window.resize(*SIZE)
        open_and_wait(qtbot, window, self.path)
        window.refresh()  # updates the entries of lists
        self._restore_inputs()
        window.messages.clear()
        window.refresh()
        if window.docks.state() != self._layout:
            lay_out(window, self._layout)
            self._restore_inputs()  # includes collapsed sections
        scroll_back(window)

    def _restore_inputs(self):
        for widget, setting in list(self._inputs.items()):
            if shiboken6.isValid(widget) and setting_of(widget) != setting:
                _set(widget, setting)
        for view in self.window.findChildren(QAbstractItemView):
            if view.selectionModel() is not None:
                view.clearSelection()


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
    for _ in range(2):  # first the panels in front, then their sizes
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
    window.canvas.look_along("iso")
    window.canvas.fit()
    window.canvas.camera_animation.restart()
    QTest.mouseMove(window, QPoint(1, 1))
    window.activateWindow()
    window.windowHandle().requestActivate()
    qtbot.waitUntil(window.isActiveWindow, timeout=PATIENCE)  # otherwise shortcuts have no effect
    if QApplication.focusWidget() is not None:
        QApplication.focusWidget().clearFocus()
    QApplication.processEvents()


def _close_others(window):
    """Close menus and dialogs."""
    while (popup := QApplication.activePopupWidget()) is not None:
        popup.close()
    for widget in QApplication.topLevelWidgets():
        if widget is not window and widget.isVisible():
            widget.close()


def setting_of(widget):
    """Return the value of an input widget; None for other widgets."""
    if isinstance(widget, QComboBox):
        return widget.currentText() if widget.isEditable() else widget.currentIndex()
    if isinstance(widget, QTabBar):
        return widget.currentIndex()
    if isinstance(widget, QAbstractSpinBox):
        return widget.text()
    if isinstance(widget, QAbstractButton):
        return widget.isChecked() if widget.isCheckable() else None
    if isinstance(widget, QAbstractSlider):
        return widget.value()
    if isinstance(widget, QLineEdit) and not isinstance(widget.parentWidget(), QAbstractSpinBox | QComboBox):
        return widget.text()
    return None


def _set(widget, setting):
    """Set the value of an input widget, with the signals of user input."""
    if isinstance(widget, QComboBox):
        if widget.isEditable():
            widget.setCurrentText(setting)
        else:
            widget.setCurrentIndex(setting)
            widget.activated.emit(setting)
    elif isinstance(widget, QTabBar):
        widget.setCurrentIndex(setting)
    elif isinstance(widget, QAbstractSpinBox):
        widget.lineEdit().setText(setting)
        widget.interpretText()
        widget.editingFinished.emit()
    elif isinstance(widget, QAbstractButton):
        widget.click() if widget.isEnabled() else widget.setChecked(setting)
    elif isinstance(widget, QAbstractSlider):
        widget.setValue(setting)
    else:
        widget.setText(setting)
        widget.textEdited.emit(setting)
        widget.editingFinished.emit()
