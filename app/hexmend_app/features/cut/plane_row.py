"""Row that selects, adds and removes cutting planes."""

from __future__ import annotations

from PySide6.QtCore import QSignalBlocker, Qt
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
    """

    def __init__(self, most: int, parent: QWidget | None = None):
        super().__init__(parent)
        self._most = most
        self.tabs = QTabBar()
        self.tabs.setDrawBase(False)
        self.tabs.setExpanding(False)
        self.tabs.setUsesScrollButtons(False)
        self.tabs.setElideMode(Qt.TextElideMode.ElideRight)
        self.tabs.setMinimumWidth(64)  # its hint for one tab is twice as wide
        set_help(self.tabs, tr("Plane"), tr("Plane that is edited here and in the view."))
        self.add_button, self.remove_button = QPushButton(icon("plus"), ""), QPushButton(icon("minus"), "")
        for button in (self.add_button, self.remove_button):
            button.setFixedWidth(30)
        set_help(self.add_button, tr("Add plane"), tr("Add a cutting plane."))
        set_help(self.remove_button, tr("Remove plane"), tr("Remove this cutting plane."))
        self.snap_box = QCheckBox(tr("Snap"))
        self.snap_box.setChecked(True)
        set_help(self.snap_box, tr("Snap to axes"), tr(_SNAP))
        label = labelled(tr("Plane"), self.tabs)
        fill(
            QHBoxLayout(self),
            label,
            self.tabs,
            self.add_button,
            self.remove_button,
            None,
            self.snap_box,
            margins=(0, 0, 0, 0),
        )
        self.set_planes(1, 0)

    def set_planes(self, count: int, at: int) -> None:
        """Show `count` planes and select the plane with index `at`; emits no signal."""
        with QSignalBlocker(self.tabs):
            while self.tabs.count() < count:
                self.tabs.addTab(str(self.tabs.count() + 1))
            while self.tabs.count() > count:
                self.tabs.removeTab(self.tabs.count() - 1)
            self.tabs.setCurrentIndex(at)
        self.add_button.setEnabled(count < self._most)
        self.remove_button.setEnabled(count > 1)
