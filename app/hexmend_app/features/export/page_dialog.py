"""Dialog for exports: pictures, films, reports and figure sets, with a preview of the page."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from PySide6.QtCore import QSize
from PySide6.QtGui import QImage
from PySide6.QtWidgets import QHBoxLayout, QLabel, QStackedWidget, QVBoxLayout, QWidget

from hexmend.errors import ParameterError
from hexmend_app.features.export.export_settings import ExportSettings
from hexmend_app.picture import Scene
from hexmend_app.picture.page import MM_PER_INCH, PT_PER_INCH
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import labelled, set_help
from hexmend_app.translation import tr
from hexmend_app.widgets.dialogs.preview import Preview
from hexmend_app.widgets.dialogs.save_dialog import SaveDialog
from hexmend_app.widgets.form import scrolled
from hexmend_app.widgets.inputs.combo import ComboBox

#: Initial size of the dialog relative to the screen.
_SHARE = 0.7


class PageDialog(SaveDialog):
    """Dialog to choose what is exported, its settings, and its path.

    Parameters
    ----------
    exports : sequence of ExportSettings
        Exports to choose from.
    chosen : str
        Id of the one that is shown first.
    """

    def __init__(self, exports: Sequence[ExportSettings], chosen: str, parent: QWidget | None = None):
        first = next(settings for settings in exports if settings.id == chosen)
        super().__init__(tr("the export"), first.name, first.kinds, parent)
        self.setWindowTitle(tr("Export"))
        self.preview = Preview(tr("Small preview of the page, without shading."))
        self._page_size = QLabel()
        self._choice, self._stack = ComboBox(), QStackedWidget()
        set_help(self._choice, tr("Export"), tr("What is written: a picture, a film of the run, or a report."))
        for settings in exports:
            self._choice.addItem(settings.title)
            self._stack.addWidget(scrolled(settings))
            settings.changed.connect(self._on_changed)
            settings.failed.connect(self.refuse)
        self._exports = exports
        self._stack.setMinimumWidth(max(settings.sizeHint().width() for settings in exports) + 28)
        choice = fill(QHBoxLayout(), labelled(tr("Export"), self._choice), (self._choice, 1))
        left = fill(QVBoxLayout(), (self.preview, 1), self._page_size)
        self.lay_out_below(fill(QHBoxLayout(), (left, 1), fill(QVBoxLayout(), choice, (self._stack, 1))))
        self.choose(chosen)
        self._choice.currentIndexChanged.connect(self._on_chosen)
        self.preview.drawn.connect(self.refuse)
        size = self.screen().availableSize() * _SHARE
        self.resize(size.expandedTo(QSize(1000, 640)))
        self._show_chosen()

    @property
    def settings(self) -> ExportSettings:
        """Settings of the chosen export."""
        return self._exports[self._choice.currentIndex()]

    def choose(self, id: str) -> None:
        """Show the settings of the export with an id."""
        self._choice.setCurrentIndex([settings.id for settings in self._exports].index(id))

    def check(self) -> None:
        """Raise `HexmendError` if the export cannot be written to the path."""
        self.settings.check(self.target.path())
        self.settings.scene()

    def _on_chosen(self) -> None:
        self.target.propose(self.settings.name, self.settings.kinds)
        self._show_chosen()

    def _show_chosen(self) -> None:
        self._stack.setCurrentIndex(self._choice.currentIndex())
        self._on_changed()

    def _on_changed(self) -> None:
        self.refuse("")
        try:
            scene = self.settings.scene()
        except ParameterError as error:
            self.preview.stop()
            self.refuse(str(error))
            return
        page = scene.page
        width, height = (side * MM_PER_INCH / page.resolution for side in page.size)
        text = tr(
            "{width:.4g} × {height:.4g} mm at {resolution:.0f} dpi: {size:,} × {size2:,} pixels",
            width=width,
            height=height,
            resolution=page.resolution,
            size=page.size[0],
            size2=page.size[1],
        )
        self._page_size.setText(text + (tr(", before cropping") if page.crop else ""))
        self.preview.draw_soon(lambda size: self._draw(scene, size))

    def _draw(self, scene: Scene, size: QSize) -> QImage:
        """Draw the page of a scene for a preview of some size in device pixels."""
        image = self.settings.draw(preview_scene(scene, size.width(), size.height())).convert("RGBA")
        return QImage(image.tobytes(), *image.size, QImage.Format.Format_RGBA8888).copy()


def preview_scene(scene: Scene, width: float, height: float) -> Scene:
    """Return the scene with fewer pixels and fast settings; text and lines keep their size relative to the page.

    Parameters
    ----------
    scene : Scene
    width, height : float
        Available size in pixels.
    """
    page = scene.page
    scale = min(1.0, width / page.size[0], height / page.size[1])
    dpi = page.resolution * scale
    across, down = (max(16, round(side * scale)) for side in page.size)
    edges = scene.lines.edges
    pen = edges if edges == 0 else page.line_width(scene.lines) / page.resolution * PT_PER_INCH
    fast: dict[str, Any] = {"shading": False, "supersampling": 1, "font_size": page.letters}
    small = replace(page, width=None, height=None, pixels=(across, down), dpi=max(dpi, 5.0), **fast)
    return replace(scene, page=small, lines=replace(scene.lines, edges=pen))
