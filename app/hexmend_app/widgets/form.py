"""Forms in panels."""

from __future__ import annotations

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QFormLayout, QFrame, QHBoxLayout, QScrollArea, QWidget

from hexmend_app.theme.spacing import Part, apply_spacing, fill


def form_layout(parent: QWidget) -> QFormLayout:
    """Set a form layout on `parent`, without margins, whose inputs fill the width; return it."""
    form = apply_spacing(QFormLayout(parent))
    form.setContentsMargins(0, 0, 0, 0)
    form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
    return form


def row_of(*parts: Part) -> QWidget:
    """Return a row of a form with several widgets."""
    row = QWidget()
    fill(QHBoxLayout(row), *parts, margins=(0, 0, 0, 0), spacing=4)
    return row


def scrolled(page: QWidget, area: QScrollArea | None = None) -> QScrollArea:
    """Return an area, by default a new one, that scrolls a page vertically, fits its width, and that Tab passes by."""
    area = QScrollArea() if area is None else area
    area.setWidget(page)
    area.setWidgetResizable(True)
    area.setFrameShape(QFrame.Shape.NoFrame)
    area.setFocusPolicy(Qt.FocusPolicy.NoFocus)
    area.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
    return area
