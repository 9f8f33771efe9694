"""Settings of an export, which the dialog shows next to the preview; those of films, reports and figure sets."""

from __future__ import annotations

import re
from collections.abc import Callable, Generator
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QSignalBlocker, Signal
from PySide6.QtWidgets import QComboBox, QFormLayout, QSpinBox, QVBoxLayout, QWidget

from hexmend.errors import ParameterError
from hexmend.parameters import Parametrised, declared, parameter
from hexmend_app.picture import Cut, Page, Scene
from hexmend_app.picture.page import MM_PER_INCH
from hexmend_app.report.charts import check_matplotlib
from hexmend_app.theme.spacing import apply_spacing, fill
from hexmend_app.theme.style import set_help, small_label
from hexmend_app.translation import tr
from hexmend_app.widgets.inputs.parameter_form import ParameterForm

if TYPE_CHECKING:
    from PIL import Image

    from hexmend_app.report.case import Version

_KINDS = (
    "GIF animation (*.gif);;MP4 video (*.mp4);;WebP animation, smaller files (*.webp);;PNG animation, lossless (*.png)"
)
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


class ExportSettings(QWidget):
    """Base of the settings of a picture, a film, a report or a figure set.

    Parameters
    ----------
    id : str
    title : str
        Name in the dialog.
    name : str
        Proposed name of the file.
    kinds : str
        Kinds of file in the notation of Qt; "" for a folder.

    Signals
    -------
    changed
        The user changed a setting.
    failed(str)
        Something that the user asked for has failed.
    """

    changed, failed = Signal(), Signal(str)

    def __init__(self, id: str, title: str, name: str, kinds: str):
        super().__init__()
        self.id, self.title, self.name, self.kinds = id, title, name, kinds

    def scene(self) -> Scene:
        """Return the scene of the preview; raise `ParameterError` if a setting is invalid."""
        raise NotImplementedError

    def draw(self, scene: Scene) -> Image.Image:
        """Draw the preview: the page of `scene`, which may have fewer pixels; raise `HexmendError` if it cannot be."""
        raise NotImplementedError

    def check(self, path: Path) -> None:
        """Raise `HexmendError` if the export cannot be written to a path."""
        raise NotImplementedError


class ReportSettings(ExportSettings):
    """Report, or figure set, whose preview is the figure of the whole meshes.

    Parameters
    ----------
    id, title, name, kinds : str
        See `ExportSettings`.
    help : str
        What is written.
    scene : Scene
        Scene of the view.
    versions : callable
        Returns the meshes to compare.
    """

    def __init__(
        self, id: str, title: str, name: str, kinds: str, help: str, scene: Scene, versions: Callable[[], list[Version]]
    ):
        super().__init__(id, title, name, kinds)
        self._scene, self._find_versions = scene, versions
        fill(QVBoxLayout(self), small_label(help), None)

    @cached_property
    def _versions(self) -> list[Version]:
        return self._find_versions()

    def scene(self) -> Scene:
        """Return the page of the figure of the whole meshes; raise `ParameterError` if it is too large."""
        from hexmend_app.report.figure_set import Style, figure_scene

        return figure_scene(Style(self._scene), replace(self._scene, cut=Cut()), [one.name for one in self._versions])

    def draw(self, scene: Scene) -> Image.Image:
        """Draw the figure of the whole meshes."""
        from hexmend_app.report.figure_set import draw_versions

        return draw_versions(scene, self._versions).image()

    def check(self, path: Path) -> None:
        """Raise `HexmendError` if a library is missing, or the report cannot be written to the path."""
        from hexmend_app.report.page import check_report

        check_matplotlib()
        if self.kinds:
            check_report(path)


@dataclass(frozen=True)
class FilmOptions(Parametrised):
    """Options of a film besides its page.

    Parameters
    ----------
    rate : int
        Frames per second.
    frames : int
        Largest number of frames; larger files often cannot be viewed where they are sent.
    histogram : bool
        Show a histogram next to the mesh.
    before : bool
        Show the mesh before the run next to it.
    """

    rate: int = parameter(10, low=1, high=50, unit="per second", help="Iterations shown per second.")
    frames: int = parameter(
        60, low=2, high=1000, label="At most", unit="frames", help="Longer runs are thinned out evenly."
    )
    histogram: bool = parameter(False, label="Histogram", help="Show the distribution of values next to the mesh.")
    before: bool = parameter(False, label="Before", help="Show the mesh before the run on the left of the others.")


class FilmSettings(ExportSettings):
    """Form that edits the options of a film.

    Parameters
    ----------
    scene : Scene
        Scene of the view.
    options : FilmOptions
        Initial options.
    pictures : callable
        Generates the pictures of a film with a scene and options.
    iterations : int
        Number of iterations of the run.
    name : str
        Proposed file name.
    """

    def __init__(
        self,
        scene: Scene,
        options: FilmOptions,
        pictures: Callable[[Scene, FilmOptions], Generator[Image.Image]],
        iterations: int,
        name: str,
    ):
        super().__init__("film", tr("Film of the run"), name, tr(_KINDS))
        self._scene, self._pictures = scene, pictures
        self.size_form, self.form = SizeForm(scene.page), ParameterForm(declared(FilmOptions))
        self.form.set_values(options.values())
        text = tr("{count:,} iterations, with the cut, colours and arrows of the view.", count=iterations + 1)
        fill(QVBoxLayout(self), small_label(text), self.size_form, self.form, None)
        self.size_form.changed.connect(self.changed)
        self.form.changed.connect(self.changed)

    def options(self) -> FilmOptions:
        """Return the options; raise `ParameterError` if one is invalid."""
        for problem in self.form.problems().values():
            raise ParameterError(problem)
        return FilmOptions(**self.form.values())

    def scene(self) -> Scene:
        """Return the scene of a frame; raise `ParameterError` if a setting is invalid."""
        self.options()
        return replace(self._scene, page=self.size_form.page(self._scene.page))

    def draw(self, scene: Scene) -> Image.Image:
        """Draw the first frame."""
        pictures = self._pictures(scene, self.options())
        try:
            return next(pictures)
        finally:
            pictures.close()

    def check(self, path: Path) -> None:
        """Raise `FileError` for an unknown suffix, or if the library for the format is not installed."""
        from hexmend_app.scene.film.film_files import format_of

        format_of(path)
