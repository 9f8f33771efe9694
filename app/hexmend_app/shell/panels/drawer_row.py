"""Tabs of the closed drawer."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QTabBar, QWidget

from hexmend_app.theme.style import smaller


class DrawerRow(QTabBar):
    """Tab bar in which each tab opens the drawer with its panel.

    Signals
    -------
    clicked(str)
        Id of the panel.

    Parameters
    ----------
    name : str
        Accessible name.
    """

    clicked = Signal(str)

    def __init__(self, name: str, parent: QWidget | None = None):
        super().__init__(parent)
        self.setAccessibleName(name)
        self.setDocumentMode(True)
        self.setDrawBase(False)
        self.setExpanding(False)
        self.setElideMode(Qt.TextElideMode.ElideRight)
        self.setUsesScrollButtons(False)
        self.setFont(smaller(self.font()))
        self.tabBarClicked.connect(self._on_click)
        self.hide()

    def set_panels(self, panels: Sequence[tuple[str, str, str]]) -> None:
        """List panels by id, title and help."""
        front = self.tabData(self.currentIndex())
        while self.count():
            self.removeTab(0)
        for id, title, help in panels:
            at = self.addTab(title)
            self.setTabData(at, id)
            self.setTabToolTip(at, help)
        self.set_front(front)
        self.setVisible(bool(panels))

    def set_front(self, id: str | None) -> None:
        """Select the tab of the panel that will be in front when the drawer opens."""
        for at in range(self.count()):
            if self.tabData(at) == id:
                self.setCurrentIndex(at)

    def _on_click(self, at: int) -> None:
        if at >= 0:
            self.clicked.emit(self.tabData(at))
