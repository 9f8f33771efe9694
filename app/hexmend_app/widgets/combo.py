"""Combo boxes in narrow panels."""

from __future__ import annotations

from PySide6.QtWidgets import QComboBox


def let_shrink(combo: QComboBox, letters: int) -> None:
    """Let a combo box be as narrow as so many letters, however long its entries are."""
    combo.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
    combo.setMinimumContentsLength(letters)
