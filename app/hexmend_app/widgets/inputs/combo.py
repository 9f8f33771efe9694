"""Combo boxes in narrow panels, and wheel events of inputs in panels that scroll."""

from __future__ import annotations

from typing import Any

from PySide6.QtCore import Qt
from PySide6.QtGui import QPaintEvent, QPalette, QWheelEvent
from PySide6.QtWidgets import QComboBox, QStyle, QStyleOptionComboBox, QStylePainter

#: Pixels between the icon and the text of a combo box.
_ICON_GAP = 4
#: Pixels that a list is wider than its texts.
_LIST_MARGIN = 8


class FocusedWheel:
    """Base of inputs that ignore the wheel unless focused, so that scrolling a panel does not change their values."""

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Change the value if the input has the focus."""
        if self.hasFocus():  # type: ignore[attr-defined]  # of the widget that this is mixed into
            super().wheelEvent(event)  # type: ignore[misc]
        else:
            event.ignore()


class ComboBox(QComboBox):
    """Combo box whose text is elided if the box is too narrow; Qt would clip it. The list is as wide as its texts."""

    def add(self, text: str, help: str, data: Any = None) -> None:
        """Add an entry with its tooltip and its data."""
        self.addItem(text, data)
        self.setItemData(self.count() - 1, help, Qt.ItemDataRole.ToolTipRole)

    def showPopup(self) -> None:
        """Open the list, as wide as its texts."""
        view = self.view()
        view.setMinimumWidth(view.sizeHintForColumn(self.modelColumn()) + 2 * view.frameWidth() + _LIST_MARGIN)
        super().showPopup()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the box with the elided text."""
        option, style = QStyleOptionComboBox(), self.style()
        self.initStyleOption(option)
        if self.currentIndex() < 0:
            option.currentText = self.placeholderText()
            option.palette.setBrush(QPalette.ColorRole.ButtonText, self.palette().placeholderText())
        field = QStyle.SubControl.SC_ComboBoxEditField
        width = style.subControlRect(QStyle.ComplexControl.CC_ComboBox, option, field, self).width()
        if not option.currentIcon.isNull():
            width -= option.iconSize.width() + _ICON_GAP
        option.currentText = option.fontMetrics.elidedText(option.currentText, Qt.TextElideMode.ElideRight, width)
        painter = QStylePainter(self)
        painter.drawComplexControl(QStyle.ComplexControl.CC_ComboBox, option)
        painter.drawControl(QStyle.ControlElement.CE_ComboBoxLabel, option)


def let_shrink(combo: QComboBox, letters: int) -> None:
    """Set the minimum width of a combo box in letters, regardless of its entries."""
    combo.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
    combo.setMinimumContentsLength(letters)
