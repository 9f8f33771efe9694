"""Combo box of colour maps with swatches."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QIcon, QImage, QPixmap
from PySide6.QtWidgets import QSizePolicy, QWidget

from hexmend_app.picture.colour_map import CHANGE_MAP, COLOUR_MAPS, value_maps
from hexmend_app.theme.style import set_help
from hexmend_app.translation import tr
from hexmend_app.widgets.inputs.combo import ComboBox, let_shrink

_SWATCH = QSize(48, 12)
_VALUE_MAPS_HELP = "All maps are perceptually uniform and readable with red-green colour blindness."


class MapBox(ComboBox):
    """Combo box that selects a colour map for values; changes have one fixed map.

    Signals
    -------
    chosen(str)
        The user selected the map with this name.
    """

    chosen = Signal(str)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        let_shrink(self, 6)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setIconSize(_SWATCH)
        self.activated.connect(self._on_activated)

    def show_map(self, name: str, change: bool) -> None:
        """List the maps of values, or the diverging map if `change`, and select a map by name."""
        maps = (CHANGE_MAP,) if change else value_maps()
        if self.findData(maps[0]) < 0:
            self.clear()
            for at, key in enumerate(maps):
                self.addItem(_swatch(key), tr(COLOUR_MAPS[key].title) or key, key)
                self.setItemData(at, tr(COLOUR_MAPS[key].help), Qt.ItemDataRole.ToolTipRole)
        self.setCurrentIndex(max(self.findData(name), 0))
        set_help(self, tr("Colour map"), tr(COLOUR_MAPS[CHANGE_MAP].help) if change else tr(_VALUE_MAPS_HELP))

    def _on_activated(self) -> None:
        if self.currentData() in value_maps():
            self.chosen.emit(self.currentData())


def _swatch(name: str) -> QIcon:
    """Return an icon of a map, drawn at four times its size so that it is sharp at any scale."""
    colours = np.ascontiguousarray(COLOUR_MAPS[name].table[None])
    image = QImage(colours.tobytes(), colours.shape[1], 1, 3 * colours.shape[1], QImage.Format.Format_RGB888)
    return QIcon(QPixmap.fromImage(image.scaled(_SWATCH * 4)))
