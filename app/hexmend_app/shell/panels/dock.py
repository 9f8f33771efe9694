"""Dock whose page is visible only while the dock is in front."""

from __future__ import annotations

from PySide6.QtWidgets import QDockWidget, QWidget

from hexmend_app.feature import PanelPlace


class Dock(QDockWidget):
    """Dock widget with one or several panels.

    Qt keeps docks behind other tabs visible, outside the window: Tab reaches them, and their panels are refreshed.
    Therefore the page is hidden unless the dock is in front.

    Parameters
    ----------
    name : str
        Object name, under which Qt saves its place.
    title, help : str
    place : PanelPlace
        Default place.

    Attributes
    ----------
    in_front : bool
        It is visible, not behind another tab.
    """

    def __init__(self, name: str, title: str, help: str, place: PanelPlace, parent: QWidget | None = None):
        super().__init__(title, parent)
        self.setObjectName(name)
        self.setToolTip(help)
        self.place = place
        self.in_front = False
        self._no_title = QWidget()  # as title bar: no title
        self.visibilityChanged.connect(self.set_in_front)

    def set_page(self, page: QWidget) -> None:
        """Set the page, which keeps its space in the layout while it is hidden."""
        policy = page.sizePolicy()
        policy.setRetainSizeWhenHidden(True)
        page.setSizePolicy(policy)
        self.setWidget(page)
        page.setVisible(self.in_front)

    def show_title(self, on: bool) -> None:
        """Show the title bar, or hide it where a tab shows the title already."""
        if on != (self.titleBarWidget() is None):
            self.setTitleBarWidget(None if on else self._no_title)

    def set_in_front(self, in_front: bool) -> None:
        """Show or hide the page."""
        self.in_front = in_front
        if self.widget() is not None:
            self.widget().setVisible(in_front)
