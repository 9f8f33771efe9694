"""Settings of an export, which the dialog shows next to the preview; those of a report and of a figure set."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QVBoxLayout, QWidget

from hexmend_app.picture import Cut, Scene
from hexmend_app.report.charts import check_matplotlib
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import note

if TYPE_CHECKING:
    from PIL import Image

    from hexmend_app.report.case import Version


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
        fill(QVBoxLayout(self), note(help), None)

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
