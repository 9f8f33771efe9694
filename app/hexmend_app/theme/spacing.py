"""Spacings and margins of layouts on a grid of 4 pixels, in place of those of Qt's style."""

from __future__ import annotations

from typing import TypeVar

from PySide6.QtWidgets import QLayout

Layout = TypeVar("Layout", bound=QLayout)

#: Pixels between the widgets of a layout, and around those of a widget and of a window.
GAP, MARGIN, WINDOW_MARGIN = 8, 8, 12


def on_grid(layout: Layout) -> Layout:
    """Set the spacings of a new layout, and its margins if it is that of a widget; return it.

    Parameters
    ----------
    layout : QLayout
        Box, grid or form; it may have other spacings and margins set afterwards.
    """
    layout.setSpacing(GAP)
    if isinstance(layout.parent(), QLayout) or layout.parentWidget() is None:
        return layout
    margin = WINDOW_MARGIN if layout.parentWidget().isWindow() else MARGIN
    layout.setContentsMargins(margin, margin, margin, margin)
    return layout
