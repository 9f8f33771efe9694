"""Settings of an export, which the dialog shows next to the preview; those of films, reports and figure sets."""

from __future__ import annotations

from collections.abc import Callable, Generator
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QVBoxLayout, QWidget

from hexmend.errors import ParameterError
from hexmend.parameters import Parametrised, declared, parameter
from hexmend_app.features.export.size_form import SizeForm
from hexmend_app.picture import Cut, Scene
from hexmend_app.report.charts import check_matplotlib
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import small_label
from hexmend_app.translation import tr
from hexmend_app.widgets.inputs.parameter_form import ParameterForm

if TYPE_CHECKING:
    from PIL import Image

    from hexmend_app.report.case import Version

_KINDS = (
    "GIF animation (*.gif);;MP4 video (*.mp4);;WebP animation, smaller files (*.webp);;PNG animation, lossless (*.png)"
)


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
        from hexmend_app.features.export.report_files import check_report

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
