"""Row that selects, adds and removes cutting planes."""

from __future__ import annotations

from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtWidgets import QCheckBox, QHBoxLayout, QPushButton, QTabBar, QWidget

from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import icon, labelled, set_help
from hexmend_app.translation import tr

_SNAP = "Align a plane with an axis when it is rotated close to the axis."


class PlaneRow(QWidget):
    """Row with a tab for each plane and buttons that add and remove planes.

    Parameters
    ----------
    most : int
        Largest number of planes.

    Signals
    -------
    chosen(int)
        The user selected the plane with this index.
    add_requested, remove_requested
        The user pressed the button.
    snap_changed(bool)
        The user switched snapping.
    """

    chosen = Signal(int)
    add_requested = Signal()
    remove_requested = Signal()
    snap_changed = Signal(bool)

    def __init__(self, most: int, parent: QWidget | None = None):
        super().__init__(parent)
        self._most = most
        self._tabs = QTabBar()
        self._tabs.setDrawBase(False)
        self._tabs.setExpanding(False)
        self._tabs.setUsesScrollButtons(False)
        self._tabs.setElideMode(Qt.TextElideMode.ElideRight)
        self._tabs.setMinimumWidth(64)  # its hint for one tab is twice as wide
        set_help(self._tabs, tr("Plane"), tr("Plane that is edited here and in the view."))
        self._add, self._remove = QPushButton(icon("plus"), ""), QPushButton(icon("minus"), "")
        for button in (self._add, self._remove):
            button.setFixedWidth(30)
        set_help(self._add, tr("Add plane"), tr("Add a cutting plane."))
        set_help(self._remove, tr("Remove plane"), tr("Remove this cutting plane."))
        self._snap = QCheckBox(tr("Snap"))
        self._snap.setChecked(True)
        set_help(self._snap, tr("Snap to axes"), tr(_SNAP))
        label = labelled(tr("Plane"), self._tabs)
        fill(QHBoxLayout(self), label, self._tabs, self._add, self._remove, None, self._snap, margins=(0, 0, 0, 0))
        self._tabs.currentChanged.connect(self.chosen)
        self._add.clicked.connect(self.add_requested)
        self._remove.clicked.connect(self.remove_requested)
        self._snap.clicked.connect(self.snap_changed)
        self.set_planes(1, 0)

    def set_planes(self, count: int, at: int) -> None:
        """Show `count` planes and select the plane with index `at`; emits no signal."""
        with QSignalBlocker(self._tabs):
            while self._tabs.count() < count:
                self._tabs.addTab(str(self._tabs.count() + 1))
            while self._tabs.count() > count:
                self._tabs.removeTab(self._tabs.count() - 1)
            self._tabs.setCurrentIndex(at)
        self._add.setEnabled(count < self._most)
        self._remove.setEnabled(count > 1)
