"""Form for the size of a page: a preset, or a custom size in millimetres or pixels."""

from __future__ import annotations

from dataclasses import replace

from PySide6.QtCore import QSignalBlocker, QSize, Signal
from PySide6.QtWidgets import QDoubleSpinBox, QFormLayout, QHBoxLayout, QLabel, QWidget

from hexmend_app.picture import Page
from hexmend_app.theme.spacing import fill, on_grid
from hexmend_app.theme.style import set_help
from hexmend_app.translation import tr
from hexmend_app.widgets.inputs.combo import ComboBox

#: Title, size in pixels, size in millimetres; one of the sizes is None.
_PRESETS = (
    ("Single column, 85 × 60 mm", None, (85.0, 60.0)),
    ("Full width, 170 × 106 mm", None, (170.0, 106.0)),
    ("Full HD, 1920 × 1080 pixels", (1920, 1080), None),
    ("4K, 3840 × 2160 pixels", (3840, 2160), None),
)
_MM, _PIXELS = "mm", "pixels"

#: Minimum, maximum and decimals for each unit.
_RANGES = {_MM: (5.0, 3000.0, 1), _PIXELS: (16.0, 16384.0, 0)}
#: Default resolution of a page in pixels.
_DPI = 300.0


class SizeForm(QWidget):
    """Form for the width, height and resolution of a page.

    Parameters
    ----------
    view : QSize
        Size of the 3D view in device pixels, the first preset.
    page : Page
        Initial page.

    Signals
    -------
    changed
        The user has changed the size.
    """

    changed = Signal()

    def __init__(self, view: QSize, page: Page, parent: QWidget | None = None):
        super().__init__(parent)
        self.preset, self.unit = ComboBox(), ComboBox()
        size = view.width(), view.height()
        self.preset.addItem(tr("Current view, {width} × {height} pixels", width=size[0], height=size[1]), (size, None))
        for title, pixels, mm in _PRESETS:
            self.preset.addItem(tr(title), (pixels, mm))
        self.preset.addItem(tr("Custom"), None)
        set_help(self.preset, tr("Preset"), tr("Common picture sizes."))
        for unit in (_MM, _PIXELS):
            self.unit.addItem(tr(unit), unit)
        set_help(self.unit, tr("Unit"), tr("Millimetres on paper, or pixels."))
        self.width_box, self.height_box, self.dpi = QDoubleSpinBox(), QDoubleSpinBox(), QDoubleSpinBox()
        set_help(self.width_box, tr("Width"), tr("Width of the picture."))
        set_help(self.height_box, tr("Height"), tr("Height of the picture."))
        set_help(self.dpi, tr("Resolution"), tr("Pixels per inch of paper: 300 to 600 for print."))
        self.dpi.setRange(5, 4800)
        self.dpi.setDecimals(0)
        self.dpi.setSuffix(tr(" dpi"))
        row = fill(QHBoxLayout(), self.width_box, QLabel("×"), self.height_box, self.unit, None)
        layout = on_grid(QFormLayout(self))
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addRow(self.preset)
        layout.addRow(row)
        layout.addRow(tr("Resolution"), self.dpi)
        self.show_page(page)
        self.preset.activated.connect(self._on_preset)
        self.unit.activated.connect(self._on_unit)
        for box in (self.width_box, self.height_box, self.dpi):
            box.valueChanged.connect(self._on_typed)

    def show_page(self, page: Page) -> None:
        """Show the size of a page without sending a signal."""
        unit = _MM if page.pixels is None and (page.width or page.height) else _PIXELS
        size = [side * 25.4 / page.resolution for side in page.size] if unit == _MM else page.size
        self._show(unit, *size)
        with QSignalBlocker(self.dpi):
            self.dpi.setValue(page.resolution if unit == _MM else _DPI)
        self._find_preset()

    def page(self, base: Page) -> Page:
        """Return a copy of `base` with the size in the form.

        Raises
        ------
        ParameterError
            If the page has too many pixels.
        """
        width, height = self.width_box.value(), self.height_box.value()
        if self.unit.currentData() == _MM:
            return replace(base, width=width, height=height, pixels=None, dpi=self.dpi.value())
        return replace(base, width=None, height=None, pixels=(int(width), int(height)), dpi=None)

    def _show(self, unit: str, width: float, height: float) -> None:
        self.unit.setCurrentIndex(self.unit.findData(unit))
        low, high, decimals = _RANGES[unit]
        for box, value in ((self.width_box, width), (self.height_box, height)):
            with QSignalBlocker(box):
                box.setDecimals(decimals)
                box.setRange(low, high)
                box.setValue(value)
        self.dpi.setEnabled(unit == _MM)

    def _find_preset(self) -> None:
        size = self.width_box.value(), self.height_box.value()
        for at in range(self.preset.count() - 1):
            pixels, mm = self.preset.itemData(at)
            if size == (pixels if mm is None else mm) and self.unit.currentData() == (_PIXELS if mm is None else _MM):
                self.preset.setCurrentIndex(at)
                return
        self.preset.setCurrentIndex(self.preset.count() - 1)

    def _on_preset(self) -> None:
        if self.preset.currentData() is not None:
            pixels, mm = self.preset.currentData()
            self._show(*((_PIXELS, *pixels) if mm is None else (_MM, *mm)))
            self.changed.emit()

    def _on_unit(self) -> None:
        """Convert the size to the other unit."""
        mm_per_pixel = 25.4 / self.dpi.value()
        width, height = self.width_box.value(), self.height_box.value()
        if self.unit.currentData() == _MM:
            self._show(_MM, width * mm_per_pixel, height * mm_per_pixel)
        else:
            self._show(_PIXELS, round(width / mm_per_pixel), round(height / mm_per_pixel))
        self._find_preset()
        self.changed.emit()

    def _on_typed(self) -> None:
        self._find_preset()
        self.changed.emit()
