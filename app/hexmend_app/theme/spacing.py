"""Spacings and margins of layouts on a grid of 4 pixels, in place of the defaults of Qt's style."""

from __future__ import annotations

from typing import TypeVar

from PySide6.QtWidgets import QBoxLayout, QLayout, QWidget

Layout = TypeVar("Layout", bound=QLayout)
Box = TypeVar("Box", bound=QBoxLayout)

#: Part of a row or column: a widget or layout, with its stretch if it has one; empty pixels; or None for an
#: empty stretch.
Part = QWidget | QLayout | tuple[QWidget | QLayout, int] | int | None

#: Pixels between the widgets of a layout, and around those of a widget and of a window.
GAP, MARGIN, WINDOW_MARGIN = 8, 8, 12


def apply_spacing(layout: Layout) -> Layout:
    """Set the spacings of a new layout, and its margins if it belongs to a widget; return it.

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


def clear(layout: QLayout) -> None:
    """Remove and delete the widgets of a layout."""
    while (item := layout.takeAt(0)) is not None:
        item.widget().hide()
        item.widget().deleteLater()


def fill(layout: Box, *parts: Part, margins: tuple[int, int, int, int] | None = None, spacing: int | None = GAP) -> Box:
    """Add parts to a new row or column and return it.

    Parameters
    ----------
    layout : QBoxLayout
    parts : sequence of Part
    margins : tuple of int, optional
        Left, top, right and bottom margin in pixels; by default those of `apply_spacing`.
    spacing : int, optional
        Pixels between the parts; None for that of the layout around it.
    """
    apply_spacing(layout).setSpacing(-1 if spacing is None else spacing)
    if margins is not None:
        layout.setContentsMargins(*margins)
    for part in parts:
        item, stretch = part if isinstance(part, tuple) else (part, 0)
        if item is None:
            layout.addStretch()
        elif isinstance(item, int):
            layout.addSpacing(item)
        elif isinstance(item, QWidget):
            layout.addWidget(item, stretch)
        else:
            layout.addLayout(item, stretch)
    return layout
