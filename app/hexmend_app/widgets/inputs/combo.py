"""Combo boxes in narrow panels."""

from __future__ import annotations

from PySide6.QtWidgets import QComboBox


def let_shrink(combo: QComboBox, letters: int) -> None:
    """Set the minimum width of a combo box in letters, regardless of its entries."""
    combo.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
    combo.setMinimumContentsLength(letters)
