"""Stacked panels in a scroll area."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication, QScrollArea, QStyle, QVBoxLayout, QWidget

from hexmend_app.feature import Panel
from hexmend_app.widgets.section import Section

#: Extra width in pixels, for texts that grow with their figures.
_LONGER = 2


class _Column(QScrollArea):
    """A scroll area that scrolls to the focused widget, also if the focus comes from outside.

    It does not scroll while a mouse button is pressed.
    """

    def __init__(self) -> None:
        super().__init__()
        QApplication.instance().focusChanged.connect(self._follow)

    def _follow(self, before: QWidget | None, now: QWidget | None) -> None:
        if now is not None and self.isAncestorOf(now) and not QApplication.mouseButtons():
            self.ensureWidgetVisible(now)


def column(panels: Sequence[Panel]) -> QScrollArea:
    """Stack panels; each but the first can be collapsed under its title."""
    tools = QWidget()
    layout = QVBoxLayout(tools)
    layout.setContentsMargins(6, 6, 6, 6)
    layout.setSpacing(6)
    for at, panel in enumerate(panels):
        layout.addWidget(Section(panel.title, panel.widget, panel.help) if at else panel.widget)
    layout.addStretch()
    scroll = _Column()
    scroll.setWidget(tools)
    scroll.setWidgetResizable(True)
    scroll.setFocusPolicy(Qt.FocusPolicy.NoFocus)
    scroll.setFrameShape(QScrollArea.Shape.NoFrame)
    scroll.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
    bar = scroll.style().pixelMetric(QStyle.PixelMetric.PM_ScrollBarExtent)
    scroll.setMinimumWidth(tools.minimumSizeHint().width() + bar + _LONGER)
    return scroll


def unfold(page: QWidget, panel: QWidget) -> None:
    """Expand a panel of a page and scroll to it."""
    around = panel
    while around is not page:
        around = around.parentWidget()
        if isinstance(around, Section):
            around.expand()
            if isinstance(page, QScrollArea):
                page.widget().layout().activate()
                page.ensureVisible(0, around.geometry().bottom())
                page.ensureWidgetVisible(around.toggleButton())
