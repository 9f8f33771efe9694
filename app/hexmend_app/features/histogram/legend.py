"""Legend of the histogram, in which kept distributions can be renamed and removed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeVar

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QFontMetrics
from PySide6.QtWidgets import QInputDialog, QLineEdit, QToolButton, QWidget
from superqt import QFlowLayout

from hexmend_app.theme.palette import Role
from hexmend_app.theme.spacing import clear
from hexmend_app.theme.style import on_theme_change, smaller
from hexmend_app.translation import tr
from hexmend_app.widgets.inputs.menu_button import MenuButton
from hexmend_app.widgets.legend import swatch_icon

_MAX_NAME_WIDTH, _HEIGHT = 150, 20

Entry = TypeVar("Entry", bound=QToolButton)


class HistogramLegend(QWidget):
    """Names and colours of the distributions; that of a kept one opens a menu.

    Signals
    -------
    renamed(slot, name)
        The user renamed a kept distribution.
    removed(slot)
        The user removed a kept distribution.
    """

    renamed = Signal(int, str)
    removed = Signal(int)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._flow = QFlowLayout(self)
        self._flow.setContentsMargins(0, 0, 0, 0)
        self._flow.setHorizontalSpacing(4)
        self._flow.setVerticalSpacing(0)
        self._shown: tuple = ()
        self.kept: dict[int, MenuButton] = {}

    def show_entries(self, fixed: Sequence[tuple[str, Role]], kept: Sequence[tuple[int, str, Role]]) -> None:
        """Show distributions by name and colour, and kept ones by slot, name and colour."""
        if (*fixed, *kept) == self._shown:
            return
        self._shown = (*fixed, *kept)
        clear(self._flow)
        for name, colour in fixed:
            self._flow.addWidget(_dressed(QToolButton(), name, colour))
        self.kept = {slot: self._entry(slot, name, colour) for slot, name, colour in kept}
        for entry in self.kept.values():
            self._flow.addWidget(entry)

    def _entry(self, slot: int, name: str, colour: Role) -> MenuButton:
        entry = MenuButton(name, tr("Distribution of {name}: rename or remove it.", name=name))
        entry.menu().addAction(tr("Rename…"), lambda: self._rename(slot, name))
        entry.menu().addAction(tr("Remove"), lambda: self.removed.emit(slot))
        return _dressed(entry, name, colour)

    def _rename(self, slot: int, name: str) -> None:
        normal = QLineEdit.EchoMode.Normal
        text, accepted = QInputDialog.getText(self, tr("Rename"), tr("Name of the distribution:"), normal, name)
        if accepted and text.strip():
            self.renamed.emit(slot, text.strip())


def _dressed(entry: Entry, name: str, colour: Role) -> Entry:
    """Give an entry its name and colour."""
    entry.setFont(smaller(entry.font()))
    entry.setText(QFontMetrics(entry.font()).elidedText(name, Qt.TextElideMode.ElideMiddle, _MAX_NAME_WIDTH))
    on_theme_change(entry, lambda: entry.setIcon(swatch_icon(colour)))
    entry.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
    entry.setAutoRaise(True)
    entry.setFixedHeight(_HEIGHT)
    if entry.menu() is None:
        entry.setFocusPolicy(Qt.FocusPolicy.NoFocus)  # it does nothing
    return entry
