"""Settings of a film of a run."""

from __future__ import annotations

from collections.abc import Callable, Generator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtWidgets import QVBoxLayout

from hexmend.errors import ParameterError
from hexmend.parameters import Parametrised, declared, parameter
from hexmend_app.features.export.export_settings import ExportSettings
from hexmend_app.features.export.size_form import SizeForm
from hexmend_app.picture import Scene
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import note
from hexmend_app.translation import tr
from hexmend_app.widgets.inputs.parameter_form import ParameterForm

if TYPE_CHECKING:
    from PIL import Image

_KINDS = (
    "GIF animation (*.gif);;MP4 video (*.mp4);;WebP animation, smaller files (*.webp);;PNG animation, lossless (*.png)"
)


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
        fill(QVBoxLayout(self), note(text), self.size_form, self.form, None)
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
