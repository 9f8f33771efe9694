"""Settings of a picture: the tables of its scene."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from PySide6.QtWidgets import QFormLayout, QHBoxLayout, QLabel, QLineEdit, QVBoxLayout, QWidget

from hexmend.errors import FileError, ParameterError
from hexmend_app.features.export.export_settings import ExportSettings, SizeForm
from hexmend_app.picture import Camera, PicturePanel, Scene, read_scene, write_scene
from hexmend_app.picture.camera import DIRECTIONS, merged
from hexmend_app.theme.spacing import apply_spacing, fill
from hexmend_app.theme.style import push_button, set_help
from hexmend_app.translation import tr
from hexmend_app.widgets.dialogs.questions import ask_to_open, ask_to_save
from hexmend_app.widgets.inputs.combo import ComboBox
from hexmend_app.widgets.inputs.key_form import KeyForm

if TYPE_CHECKING:
    from PIL import Image

_KINDS = "PNG picture (*.png);;PDF (*.pdf);;SVG (*.svg);;TIFF picture (*.tif)"

#: Title of a group, its table of the scene, and the keys of the table.
_GROUPS = (
    ("Page", "page", ("background", "margin", "crop", "shading", "supersampling")),
    ("Lines", "lines", ("edges",)),
    ("Text", "page", ("captions", "figures", "font_size", "columns")),
    ("Colour bar", "bar", ("place", "ticks", "title")),
    ("Axes", "axes", ("show", "place")),
)

#: Keys that are shown only for several views.
_SEVERAL_VIEWS = ("captions", "figures", "columns")


class PictureSettings(ExportSettings):
    """Form that edits the scene of a picture.

    Parameters
    ----------
    scene : Scene
        Scene of the view.
    draw : callable
        Draws the page of a scene.
    name : str
        Proposed file name.
    views : sequence of str
        Names of the views; empty for one view.
    """

    def __init__(self, scene: Scene, draw: Callable[[Scene], Image.Image], name: str, views: Sequence[str] = ()):
        super().__init__("picture", tr("Picture"), name, tr(_KINDS))
        self._view_scene = self._base = scene
        self._draw = draw
        self.size_form = SizeForm(scene.page)
        self.camera = ComboBox()
        set_help(
            self.camera, tr("Camera"), tr("Camera of the window, a saved camera, or a standard view of the whole mesh.")
        )
        self.captions = [QLineEdit(panel.caption) for panel in scene.panels_of(max(1, len(views)))]
        several = len(self.captions) > 1
        self.forms = [
            (table, KeyForm(getattr(scene, table), [name for name in names if several or name not in _SEVERAL_VIEWS]))
            for _, table, names in _GROUPS
        ]
        self._lay_out()
        self._list_cameras()
        self.size_form.changed.connect(self.changed)
        self.camera.activated.connect(self.changed)
        for _, form in self.forms:
            form.changed.connect(self.changed)
        for line in self.captions:
            line.textEdited.connect(self.changed)

    def _lay_out(self) -> None:
        captions = QWidget()
        rows = apply_spacing(QFormLayout(captions))
        rows.setContentsMargins(0, 0, 0, 0)
        for number, line in enumerate(self.captions, 1):
            title = tr("Caption {number}", number=number) if len(self.captions) > 1 else tr("Caption")
            set_help(line, title, tr("Text above the picture."))
            rows.addRow(title, line)
        groups = [(tr("Size"), self.size_form), (tr("Camera"), self.camera)]
        groups += [(tr(title), form) for (title, _, _), (_, form) in zip(_GROUPS, self.forms, strict=True)]
        column = apply_spacing(QVBoxLayout(self))
        for title, group in groups:
            column.addWidget(QLabel(f"<b>{title}</b>"))
            column.addWidget(group)
            if title == tr("Text"):
                column.addWidget(captions)
        load = push_button(tr("Load scene…"), tr("Load these settings from a scene file."))
        save = push_button(tr("Save scene…"), tr("Save these settings as a scene file, for hexmend render --scene."))
        kind, title = tr("Scene (*.toml)"), tr("Save scene as")
        load.clicked.connect(
            lambda: self.load(ask_to_open(self, tr("Load scene"), tr("Scenes (*.toml);;All files (*)")))
        )
        save.clicked.connect(lambda: self.save_scene(ask_to_save(self, title, "scene.toml", kind)))
        column.addLayout(fill(QHBoxLayout(), load, save, None))
        column.addStretch()
        labels = [label for label in self.findChildren(QLabel) if label.buddy() is not None]
        for label in labels:  # align the fields of all groups
            label.setMinimumWidth(max(other.sizeHint().width() for other in labels))

    def scene(self) -> Scene:
        """Return the scene set in the form.

        Raises
        ------
        ParameterError
            If a value is invalid.
        """
        tables: dict[str, Any] = {"page": self.size_form.page(self._base.page)}
        for name, form in self.forms:
            tables[name] = form.table(tables.get(name, getattr(self._base, name)))
        captions = [line.text() for line in self.captions]
        panels = self._base.panels
        if panels or any(captions):
            panels = panels or (PicturePanel(),)
            panels = tuple(replace(panel, caption=text) for panel, text in zip(panels, captions, strict=True))
        camera = self.camera.currentData()
        return replace(self._base, panels=panels, camera=camera or self._view_scene.camera, **tables)

    def draw(self, scene: Scene) -> Image.Image:
        """Draw the page of a scene."""
        return self._draw(scene)

    def show_scene(self, scene: Scene) -> None:
        """Show the settings and cameras of another scene; the panels of the view are preserved."""
        cameras = merged(self._view_scene.cameras, scene.cameras)
        self._base = replace(scene, panels=self._view_scene.panels, cameras=cameras)
        self.size_form.show_page(scene.page)
        for name, form in self.forms:
            form.show_table(getattr(scene, name))
        self._list_cameras()
        self.changed.emit()

    def check(self, path: Path) -> None:
        """Raise `FileError` if the picture cannot be written to the path."""
        from hexmend_app.scene.page.page_renderer import format_of

        format_of(path)

    def load(self, path: str) -> None:
        """Load a scene from a file, or report the problem; "" does nothing."""
        try:
            if path:
                self.show_scene(read_scene(path))
        except FileError as error:
            self.failed.emit(str(error))

    def save_scene(self, path: str) -> None:
        """Write the scene to a file, or report the problem; "" does nothing."""
        try:
            if path:
                write_scene(path, self.scene())
        except (FileError, ParameterError) as error:
            self.failed.emit(str(error))

    def _list_cameras(self) -> None:
        """List the cameras: the camera of the view, the named cameras of the scene, and the standard views."""
        self.camera.clear()
        self.camera.addItem(tr("Current view"), None)
        if self._base.camera not in (Camera(), self._view_scene.camera):
            self.camera.addItem(tr("Scene file"), self._base.camera)
            self.camera.setCurrentIndex(1)
        for name, camera in self._base.cameras.items():
            self.camera.addItem(name, camera)
        up = self._view_scene.camera.up
        for name in DIRECTIONS:
            title = tr("From a corner") if name == "iso" else tr("From {axis}", axis=name.upper().replace("-", "−"))
            self.camera.addItem(title, Camera(name, up=up, parallel=self._view_scene.camera.parallel))
