"""Dialog for exports: pictures, films, reports and figure sets, with a preview of the page."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QSize
from PySide6.QtWidgets import QHBoxLayout, QLabel, QStackedWidget, QVBoxLayout, QWidget

from hexmend.errors import ParameterError
from hexmend_app.features.export.export_settings import ExportSettings
from hexmend_app.features.export.preview import Preview
from hexmend_app.picture.page import MM_PER_INCH
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import labelled, set_help
from hexmend_app.translation import tr
from hexmend_app.widgets.dialogs.save_dialog import SaveDialog
from hexmend_app.widgets.form_grid import scrolled
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
        self.preview = Preview()
        self._page_size = QLabel()
        self._what, self._stack = ComboBox(), QStackedWidget()
        set_help(self._what, tr("Export"), tr("What is written: a picture, a film of the run, or a report."))
        for settings in exports:
            self._what.addItem(settings.title)
            self._stack.addWidget(scrolled(settings))
            settings.changed.connect(self._on_changed)
            settings.failed.connect(self.refuse)
        self._exports = exports
        self._stack.setMinimumWidth(max(settings.sizeHint().width() for settings in exports) + 28)
        what = fill(QHBoxLayout(), labelled(tr("Export"), self._what), (self._what, 1))
        left = fill(QVBoxLayout(), (self.preview, 1), self._page_size)
        self.lay_out_below(fill(QHBoxLayout(), (left, 1), fill(QVBoxLayout(), what, (self._stack, 1))))
        self.choose(chosen)
        self._what.currentIndexChanged.connect(self._on_chosen)
        self.preview.drawn.connect(self.refuse)
        size = self.screen().availableSize() * _SHARE
        self.resize(size.expandedTo(QSize(1000, 640)))
        self._show_chosen()

    @property
    def settings(self) -> ExportSettings:
        """Settings of the chosen export."""
        return self._exports[self._what.currentIndex()]

    def choose(self, id: str) -> None:
        """Show the settings of the export with an id."""
        self._what.setCurrentIndex([settings.id for settings in self._exports].index(id))

    def check(self) -> None:
        """Raise `HexmendError` if the export cannot be written to the path."""
        self.settings.check(self.target.path())
        self.settings.scene()

    def _on_chosen(self) -> None:
        self.target.propose(self.settings.name, self.settings.kinds)
        self._show_chosen()

    def _show_chosen(self) -> None:
        self._stack.setCurrentIndex(self._what.currentIndex())
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
        self.preview.show_scene(scene, self.settings.draw)
