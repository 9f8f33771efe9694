"""Stacked panels in a scroll area."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QEvent, QObject
from PySide6.QtWidgets import QScrollArea, QVBoxLayout, QWidget

from hexmend_app.feature import Panel
from hexmend_app.theme.spacing import fill
from hexmend_app.widgets.form import scrolled
from hexmend_app.widgets.section import Section

#: Extra width in pixels, for texts whose numbers grow.
_EXTRA_WIDTH = 2


class _StackArea(QScrollArea):
    """Scroll area that is at least as wide as its page."""

    def __init__(self, page: QWidget) -> None:
        super().__init__()
        self.verticalScrollBar().ensurePolished()  # the style sheet sets its width
        scrolled(page, self)
        self._fit()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Follow the width that the page needs."""
        if watched is self.widget() and event.type() in (QEvent.Type.LayoutRequest, QEvent.Type.Resize):
            self._fit()
        return super().eventFilter(watched, event)

    def _fit(self) -> None:
        width = self.widget().minimumSizeHint().width() + self.verticalScrollBar().sizeHint().width() + _EXTRA_WIDTH
        self.setMinimumWidth(max(width, self.minimumWidth()))


def stack(panels: Sequence[Panel]) -> QScrollArea:
    """Return a scroll area with panels one below the other; all but the first can be collapsed under their titles."""
    page = QWidget()
    sections = (Section(panel.title, panel.widget, panel.help) for panel in panels[1:])
    fill(QVBoxLayout(page), panels[0].widget, *sections, None, margins=(4, 8, 4, 8))
    return _StackArea(page)


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


def scroll_to(widget: QWidget) -> None:
    """Scroll the areas around a widget so that it is visible; Qt does so only for Tab within an area."""
    parent = widget.parentWidget()
    while parent is not None:
        if isinstance(parent, QScrollArea):
            parent.ensureWidgetVisible(widget)
        parent = parent.parentWidget()
