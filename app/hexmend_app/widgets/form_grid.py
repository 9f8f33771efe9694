"""Grid layout of forms in panels: labels on the left, stretching widgets on the right."""

from __future__ import annotations

from PySide6.QtWidgets import QGridLayout, QWidget


def form_grid(parent: QWidget, widest_label: str = "") -> QGridLayout:
    """Set a grid layout on `parent`, with a label column at least as wide as a text, and return it."""
    grid = QGridLayout(parent)
    grid.setContentsMargins(0, 0, 0, 0)
    grid.setHorizontalSpacing(8)
    grid.setVerticalSpacing(8)
    grid.setColumnStretch(1, 1)
    grid.setColumnMinimumWidth(0, parent.fontMetrics().horizontalAdvance(widest_label))
    return grid
