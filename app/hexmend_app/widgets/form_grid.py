"""Grid layout of forms in panels: labels on the left, stretching widgets on the right."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QFrame, QGridLayout, QScrollArea, QWidget


def form_grid(parent: QWidget, widest_label: str = "") -> QGridLayout:
    """Set a grid layout on `parent`, with a label column at least as wide as a text, and return it."""
    grid = QGridLayout(parent)
    grid.setContentsMargins(0, 0, 0, 0)
    grid.setHorizontalSpacing(8)
    grid.setVerticalSpacing(8)
    grid.setColumnStretch(1, 1)
    grid.setColumnMinimumWidth(0, parent.fontMetrics().horizontalAdvance(widest_label))
    return grid


def scrolled(page: QWidget) -> QScrollArea:
    """Return an area that scrolls a page vertically, fits it horizontally, and is not reached by Tab."""
    area = QScrollArea()
    area.setWidget(page)
    area.setWidgetResizable(True)
    area.setFrameShape(QFrame.Shape.NoFrame)
    area.setFocusPolicy(Qt.FocusPolicy.NoFocus)
    area.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
    return area
