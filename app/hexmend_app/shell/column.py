"""Panels one below the other, that scroll where there is no room."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QApplication, QScrollArea, QStyle, QVBoxLayout, QWidget

from hexmend_app.feature import Panel
from hexmend_app.widgets.section import Section

#: Pixels that a column has to spare, for words that are longer once there are figures in them.
_LONGER = 2


class _Column(QScrollArea):
    """Shows what the focus comes to by keys, from within or from elsewhere, which Qt's own scrolls to only from within.

    What a mouse button is pressed on is not moved away under it.
    """

    def __init__(self) -> None:
        super().__init__()
        QApplication.instance().focusChanged.connect(self._follow)

    def _follow(self, before: QWidget | None, now: QWidget | None) -> None:
        if now is not None and self.isAncestorOf(now) and not QApplication.mouseButtons():
            self.ensureWidgetVisible(now)


def column(panels: Sequence[Panel]) -> QScrollArea:
    """Panels one below the other; each but the first folds away under its title."""
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
    """Show a panel of a page, which may be folded away under its title, and as much of it as there is room for."""
    around = panel
    while around is not page:
        around = around.parentWidget()
        if isinstance(around, Section):
            around.expand()
            if isinstance(page, QScrollArea):
                page.widget().layout().activate()
                page.ensureVisible(0, around.geometry().bottom())
                page.ensureWidgetVisible(around.toggleButton())
