"""Panels in tabs, one of which is in front; those below the view fold away to their tabs."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtWidgets import QSplitter, QStackedWidget, QTabWidget, QWidget

from hexmend_app.widgets.style import smaller

# Qt's QWIDGETSIZE_MAX, which PySide6 does not hand on.
_UNBOUNDED = (1 << 24) - 1


class Tabs(QTabWidget):
    """Pages behind tabs; a page that is closed has none until it is brought to the front.

    Signals
    -------
    changed
        Another page can be seen.

    Parameters
    ----------
    name : str
        For those who cannot see it.
    """

    changed = Signal()

    def __init__(self, name: str, parent: QWidget | None = None):
        super().__init__(parent)
        self.setDocumentMode(True)
        self.setMovable(True)
        self.setElideMode(Qt.TextElideMode.ElideNone)
        self.setUsesScrollButtons(True)
        self.setFocusProxy(None)  # or Tab comes to the row of tabs where this stands in its order
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.tabBar().setFont(smaller(self.tabBar().font()))
        self.tabBar().setAccessibleName(name)
        self.tabBar().setExpanding(False)
        self.tabBar().setDrawBase(False)
        self.currentChanged.connect(self.changed)

    def add(self, page: QWidget, title: str, help: str) -> None:
        """Put a page behind a tab of its own."""
        self.setTabToolTip(self.addTab(page, title), help)

    def read_before_pages(self) -> None:
        """Let Tab come to the tabs right before the pages, which were added later and elsewhere in its order."""
        before = self.widget(0) or self.tabBar()
        while before is not self.tabBar():
            before = before.previousInFocusChain()
            if before.focusPolicy() & Qt.FocusPolicy.TabFocus:  # after any other, Qt puts nothing
                self.setTabOrder(before, self.tabBar())
                break

    def offer(self, page: QWidget) -> None:
        """Bring a page to the front of the others."""
        at = self.indexOf(page)
        self.setTabVisible(at, True)
        self.setCurrentIndex(at)

    def bring(self, page: QWidget) -> None:
        """Bring a page to the front, where it can be seen."""
        self.offer(page)
        self.changed.emit()

    def close_page(self, page: QWidget) -> None:
        """Take a page's tab away."""
        self.setTabVisible(self.indexOf(page), False)
        self.changed.emit()

    def is_open(self, page: QWidget) -> bool:
        """Whether a page has a tab."""
        return self.isTabVisible(self.indexOf(page))

    def shows(self, page: QWidget) -> bool:
        """Whether a page is in front."""
        return self.currentWidget() is page

    @property
    def front(self) -> str:
        """Title of the page in front."""
        return self.tabText(self.currentIndex())

    def set_front(self, title: str) -> None:
        """Bring the page of a title to the front, if there is one."""
        for at in range(self.count()):
            if self.tabText(at) == title:
                self.setCurrentIndex(at)


class Drawer(Tabs):
    """Tabs that fold away: a click on the tab in front closes the drawer, a click on any tab opens it.

    Attributes
    ----------
    height_unfolded : int
        Pixels that it has when it is open.
    """

    def __init__(self, name: str, parent: QWidget | None = None):
        super().__init__(name, parent)
        self.height_unfolded = 260
        self.folded = False
        self.tabBarClicked.connect(self._on_click)
        self.set_folded(True)

    @property
    def height_open(self) -> int:
        """Pixels that it has while it is open, or had then."""
        seen = self.isVisible() and not self.folded and self.height() > self.tabBar().height()
        return self.height() if seen else self.height_unfolded

    def set_folded(self, folded: bool) -> None:
        """Leave nothing but the tabs, or show the page in front."""
        if folded == self.folded:
            return
        self.height_unfolded = self.height_open
        self.folded = folded
        self.findChild(QStackedWidget).setVisible(not folded)
        self._fit()
        self.changed.emit()

    def tabInserted(self, index: int) -> None:
        """Be as high as the tabs, which are higher than none."""
        super().tabInserted(index)
        if self.folded:
            self._fit()

    def _fit(self) -> None:
        bar = max(self.tabBar().sizeHint().height(), 24)
        self.setMinimumHeight(bar)
        self.setMaximumHeight(bar if self.folded else _UNBOUNDED)
        self._share(bar if self.folded else self.height_unfolded)

    def sizeHint(self) -> QSize:
        """Folded, as high as its tabs: a splitter gives it that at first, and more would be left empty."""
        size = super().sizeHint()
        return QSize(size.width(), min(size.height(), self.maximumHeight()))

    def set_height_open(self, height: int) -> None:
        """Have so many pixels as soon as it is open."""
        self.height_unfolded = height
        if not self.folded:
            self._share(height)

    def _share(self, height: int) -> None:
        """Take so much of the room, and leave what is above it the rest; by itself Qt leaves that empty."""
        splitter = self.parentWidget()
        if isinstance(splitter, QSplitter):
            splitter.setSizes([splitter.height() - splitter.handleWidth() - height, height])

    def bring(self, page: QWidget) -> None:
        """Bring a page to the front, and open the drawer."""
        super().bring(page)
        self.set_folded(False)

    def shows(self, page: QWidget) -> bool:
        """Whether a page is in front of the open drawer."""
        return super().shows(page) and not self.folded

    def _on_click(self, at: int) -> None:
        if at >= 0:
            self.set_folded(at == self.currentIndex() and not self.folded)
