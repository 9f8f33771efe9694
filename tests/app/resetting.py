"""The window that tests share, brought back to how it was when it was first seen."""

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

from hexmend.run import StoppingCriteria
from hexmend.run.recipe import Stage
from hexmend.smoothers import DEFAULT_METHOD, METHODS
from hexmend_app.bench.windows import end_run
from hexmend_app.picture.appearance import Look
from hexmend_app.picture.named_cameras import NamedCameras
from hexmend_app.state.mesh.history import LIMIT
from hexmend_app.state.run.timeline import SPEED
from hexmend_app.theme import theme_choice
from tests.app.driving import open_and_wait

SIZE = 1400, 900


class Resetting:
    """Knows how a window was, and brings it back to that.

    Parameters
    ----------
    window : Window
        As tests are to find it, with a mesh open.
    path : Path
        The mesh's file.
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
        """End what is going on."""
        _close_others(self.window)
        for feature in self.window.features.values():
            feature.close()
        session = self.window.session
        end_run(session)
        session.comparison.cancel()
        session.opener.cancel()

    def reset(self, qtbot):
        """Put everything back, and open the mesh anew."""
        self.end()
        with unseen(self.window):
            self._reset_session()
            self._open_anew(qtbot)
            settle(qtbot, self.window)
        QApplication.processEvents()

    def _reset_session(self):
        """What is set goes back, whatever the mesh."""
        session = self.window.session
        session.node_sweep.leave()
        QSettings().clear()
        theme_choice.apply_theme()
        self._put_back()
        for method in METHODS.values():  # a form takes its time
            if session.run_setup.values_of(method.name) not in ({}, method().values()):
                session.run_setup.choose(Stage(method(), StoppingCriteria()))
        session.run_setup.choose(Stage(METHODS[DEFAULT_METHOD](), StoppingCriteria()))
        session.run_setup.active_stage = None
        while session.recipe_draft.stages:
            session.recipe_draft.remove(0)
        session.recipe_draft.rename("")
        session.history.limit = LIMIT
        session.timeline.pause()
        session.timeline.set_speed(SPEED)
        session.side_views.close_all()
        session.saved_cameras.restore(NamedCameras())
        session.view.change(**{name: getattr(Look(), name) for name in Look.__dataclass_fields__})
        session.view.set_handles(True)
        session.view.set_snap(True)
        session.view.set_rings(1)

    def _open_anew(self, qtbot):
        """The mesh as it is in its file, in a window laid out as it was."""
        window = self.window
        window.canvas.set_parallel(False)
        window.canvas.set_up("z")
        window.showNormal()
        window.resize(*SIZE)
        open_and_wait(qtbot, window, self.path)
        window.refresh()  # what a list offers is what there is now
        self._put_back()
        window.messages.clear()
        window.refresh()
        if window.docks.state() != self._layout:
            lay_out(window, self._layout)
            self._put_back()  # what was folded, too
        scroll_back(window)

    def _put_back(self):
        for widget, setting in list(self._inputs.items()):
            if shiboken6.isValid(widget) and setting_of(widget) != setting:
                _set(widget, setting)
        for view in self.window.findChildren(QAbstractItemView):
            if view.selectionModel() is not None:
                view.clearSelection()


@contextmanager
def unseen(window):
    """Draw nothing meanwhile: most of the time of a reset would go into pictures that nobody looks at."""
    window.setUpdatesEnabled(False)
    try:
        yield
    finally:
        window.setUpdatesEnabled(True)


def lay_out(window, layout):
    """Let panels stand as they did."""
    for panel in window.docks.ids():
        window.docks.show_panel(panel)  # what is closed in the layout is closed again
    for _ in range(2):  # first what is in front, then what room that has
        window.docks.restore(layout)
        QApplication.processEvents()


def scroll_back(window):
    """Let everything be seen from its beginning."""
    QApplication.processEvents()
    for bar in window.findChildren(QScrollBar):
        if shiboken6.isValid(bar):  # what one of them moves may take others along
            bar.setValue(bar.minimum())


def settle(qtbot, window):
    """Look at the whole mesh from a corner, with the window in front and the keyboard at no part of it."""
    window.refresh()
    window.canvas.look_along("iso")
    window.canvas.fit()
    window.canvas.travel.restart()
    QTest.mouseMove(window, QPoint(1, 1))
    window.activateWindow()
    window.windowHandle().requestActivate()
    qtbot.waitUntil(window.isActiveWindow, timeout=5000)  # or shortcuts go nowhere
    if QApplication.focusWidget() is not None:
        QApplication.focusWidget().clearFocus()
    QApplication.processEvents()


def _close_others(window):
    """Close menus and dialogs."""
    while (popup := QApplication.activePopupWidget()) is not None:
        popup.close()
    for one in QApplication.topLevelWidgets():
        if one is not window and one.isVisible():
            one.close()


def setting_of(widget):
    """What a hand has set in a widget; None where it cannot be set."""
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
    """Set a widget as a hand would, so that whoever listens hears of it."""
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
