"""Stacked panels in a scroll area."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QApplication, QScrollArea, QVBoxLayout, QWidget

from hexmend_app.feature import Panel
from hexmend_app.shell.focus_changes import follow_focus
from hexmend_app.theme.spacing import fill
from hexmend_app.widgets.section import Section

#: Extra width in pixels, for texts whose numbers grow.
_EXTRA_WIDTH = 2


class _Page(QWidget):
    """Page that tells when it has another size, as where its panels need more than a scroll area has."""

    resized = Signal()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Tell of it."""
        super().resizeEvent(event)
        self.resized.emit()


class _StackArea(QScrollArea):
    """Scroll area as wide as its page that scrolls to the focused widget, unless a mouse button is pressed.

    Qt does so only if the focus comes from inside the area.
    """

    def __init__(self, page: _Page) -> None:
        super().__init__()
        self.verticalScrollBar().ensurePolished()  # the style sheet sets its width
        self.setWidget(page)
        self._fit()
        page.resized.connect(self._fit)
        follow_focus(self)

    def _fit(self) -> None:
        width = self.widget().minimumSizeHint().width() + self.verticalScrollBar().sizeHint().width() + _EXTRA_WIDTH
        self.setMinimumWidth(max(width, self.minimumWidth()))

    def focus_moved(self, now: QWidget | None) -> None:
        """Scroll to a widget of the area that receives the focus."""
        if now is not None and self.isAncestorOf(now) and not QApplication.mouseButtons():
            self.ensureWidgetVisible(now)


def stack(panels: Sequence[Panel]) -> QScrollArea:
    """Return a scroll area with panels one below the other; all but the first can be collapsed under their titles."""
    page = _Page()
    sections = (Section(panel.title, panel.widget, panel.help) for panel in panels[1:])
    fill(QVBoxLayout(page), panels[0].widget, *sections, None, margins=(4, 8, 4, 8))
    scroll = _StackArea(page)
    scroll.setWidgetResizable(True)
    scroll.setFocusPolicy(Qt.FocusPolicy.NoFocus)
    scroll.setFrameShape(QScrollArea.Shape.NoFrame)
    scroll.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
    return scroll


def unfold(page: QWidget, panel: QWidget) -> None:
    """Expand a panel of a page and scroll to it."""
    parent = panel
    while parent is not page:
        parent = parent.parentWidget()
        if isinstance(parent, Section):
            parent.expand()
            if isinstance(page, QScrollArea):
                page.widget().layout().activate()
                page.ensureVisible(0, parent.geometry().bottom())
                page.ensureWidgetVisible(parent.toggleButton())
