"""Form for the size of a page: common sizes, or a typed size in millimetres or pixels."""

from __future__ import annotations

import re
from dataclasses import replace

from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtWidgets import QComboBox, QFormLayout, QSpinBox, QWidget

from hexmend.errors import ParameterError
from hexmend_app.picture import Page
from hexmend_app.picture.page import MM_PER_INCH
from hexmend_app.theme.spacing import apply_spacing
from hexmend_app.theme.style import set_help
from hexmend_app.translation import tr

#: Common sizes: a column and the width of a printed page, and screens.
_SIZES = ("85 × 60 mm", "170 × 106 mm", "1920 × 1080 pixels", "3840 × 2160 pixels")

#: Default resolution of pages in millimetres.
_DPI = 300


class SizeForm(QWidget):
    """Form for the width, height and resolution of a page.

    Parameters
    ----------
    page : Page
        Initial page, whose size is offered first.

    Signals
    -------
    changed
        The user has changed the size.
    """

    changed = Signal()

    def __init__(self, page: Page, parent: QWidget | None = None):
        super().__init__(parent)
        self.size_box, self.dpi = QComboBox(editable=True), QSpinBox()
        self.size_box.setInsertPolicy(QComboBox.InsertPolicy.NoInsert)
        self.size_box.addItems(list(dict.fromkeys((_text(page), *_SIZES))))
        set_help(self.size_box, tr("Size"), tr("Common size, or any width × height in mm on paper or in pixels."))
        set_help(self.dpi, tr("Resolution"), tr("Pixels per inch of paper: 300 to 600 for print."))
        self.dpi.setRange(5, 4800)
        self.dpi.setSuffix(tr(" dpi"))
        layout = apply_spacing(QFormLayout(self))
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addRow(tr("Size"), self.size_box)
        layout.addRow(tr("Resolution"), self.dpi)
        self.show_page(page)
        self.size_box.editTextChanged.connect(self._on_changed)
        self.dpi.valueChanged.connect(self._on_changed)

    def show_page(self, page: Page) -> None:
        """Show the size of a page without sending a signal."""
        with QSignalBlocker(self.size_box), QSignalBlocker(self.dpi):
            self.size_box.setEditText(_text(page))
            self.dpi.setValue(round(page.resolution) if _in_mm(page) else _DPI)
        self.dpi.setEnabled(_in_mm(page))

    def page(self, base: Page) -> Page:
        """Return a copy of `base` with the size in the form.

        Raises
        ------
        ParameterError
            If the text is no size, or the page has too many pixels.
        """
        text = self.size_box.currentText()
        found = re.fullmatch(r"\s*([\d.]+)\s*[×x*]\s*([\d.]+)\s*(mm|px|pixels)\s*", text)
        try:
            width, height = map(float, found.group(1, 2))
        except (AttributeError, ValueError):
            raise ParameterError(f"size {text!r}: expected width × height in mm or pixels, as in {_SIZES[0]}") from None
        if found[3] == "mm":
            return replace(base, width=width, height=height, pixels=None, dpi=float(self.dpi.value()))
        return replace(base, width=None, height=None, pixels=(round(width), round(height)), dpi=None)

    def _on_changed(self) -> None:
        self.dpi.setEnabled("mm" in self.size_box.currentText())
        self.changed.emit()


def _in_mm(page: Page) -> bool:
    return page.pixels is None and bool(page.width or page.height)


def _text(page: Page) -> str:
    """Return the size of a page as text."""
    if not _in_mm(page):
        return f"{page.size[0]} × {page.size[1]} pixels"
    in_mm = [round(side * MM_PER_INCH / page.resolution, 1) for side in page.size]
    return f"{in_mm[0]:g} × {in_mm[1]:g} mm"
