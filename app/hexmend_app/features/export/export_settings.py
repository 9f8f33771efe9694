"""Settings of an export, which the dialog shows next to the preview."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QWidget

from hexmend_app.picture import Scene

if TYPE_CHECKING:
    from PIL import Image


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
