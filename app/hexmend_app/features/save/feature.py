"""Writing what the window shows: asked where, written, and said so, or said why not."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtWidgets import QWidget

from hexmend.errors import HexmendError
from hexmend.report import write_comparison
from hexmend_app.features.histogram.file import write_histogram
from hexmend_app.features.histogram.panel import QualityHistogram
from hexmend_app.features.inspect.file import write_worst
from hexmend_app.features.inspect.worst_list import WorstList
from hexmend_app.features.save.picture_dialog import PictureDialog
from hexmend_app.state.commands import Commands
from hexmend_app.state.comparison import Comparison
from hexmend_app.state.document import Document
from hexmend_app.widgets.message_bar import MessageBar
from hexmend_app.widgets.questions import (
    ask_comparison,
    ask_convergence,
    ask_histogram,
    ask_list,
    ask_target,
)
from hexmend_app.widgets.wording import counted

if TYPE_CHECKING:
    from hexmend_app.canvas.canvas import Canvas


class Saving:
    """Writes the mesh, the view, the histogram and the list of the worst.

    Parameters
    ----------
    parent : QWidget
        The dialogs stand before it.
    document, commands
        The window's state.
    messages : MessageBar
        Where it is said.
    histogram, worst_list
        What can be written beside the mesh.
    """

    def __init__(
        self,
        parent: QWidget,
        document: Document,
        commands: Commands,
        messages: MessageBar,
        histogram: QualityHistogram,
        worst_list: WorstList,
    ):
        self._parent = parent
        self._document = document
        self._commands = commands
        self._messages = messages
        self._histogram = histogram
        self._worst_list = worst_list
        self.canvas: Canvas | None = None
        histogram.save_requested.connect(self.ask_histogram)
        worst_list.save_requested.connect(self.ask_worst)

    def handlers(self) -> dict[str, Callable]:
        """What its actions do, by id."""
        return {"save": self.ask_mesh, "screenshot": self.ask_picture}

    def ask_mesh(self) -> bool:
        """Ask where the mesh goes and write it; whether it was."""
        path = ask_target(self._parent, self._stem)
        return bool(path) and self.mesh(path)

    def mesh(self, path: str | Path) -> bool:
        """Write the mesh as it is now."""
        left_out: list[str] = []
        saved = self._said(
            "The mesh was not saved", lambda: left_out.extend(self._commands.save(path)), f"Saved to {path}"
        )
        if left_out:
            self._messages.show_warning(
                "The tags are not in it",
                f"A {Path(path).suffix} file cannot hold {counted(len(left_out), 'tag')}: {', '.join(left_out)}. "
                "Save as .vtu or .vtk to keep them.",
            )
        return saved

    def ask_picture(self) -> None:
        """Ask how large the picture is to be and where it goes, and write it."""
        size = self.canvas.size() * self._parent.devicePixelRatioF()
        dialog = PictureDialog(size, f"{self._stem}.png", self._parent)
        if dialog.exec():
            self.picture(dialog.path(), dialog.picture_size(), dialog.transparent())

    def picture(self, path: str | Path, size: tuple[int, int], transparent: bool = False) -> bool:
        """Write the view as PNG of `size` pixels."""
        return self._said(
            "The picture was not saved",
            lambda: self.canvas.save_picture(Path(path), size, transparent),
            f"Picture of {size[0]} × {size[1]} pixels saved to {path}",
        )

    def ask_worst(self) -> None:
        """Ask where the list of the worst goes and write it."""
        path = ask_list(self._parent, self._stem)
        if path:
            self.worst(path)

    def worst(self, path: str | Path) -> bool:
        """Write the list of the worst elements as CSV."""
        return self._said(
            "The list was not saved",
            lambda: write_worst(Path(path), self._worst_list),
            f"{counted(len(self._worst_list.elements), 'element')} saved to {path}",
        )

    def ask_histogram(self) -> None:
        """Ask where the histogram goes and write it."""
        path = ask_histogram(self._parent, self._stem)
        if path:
            self.histogram(path)

    def histogram(self, path: str | Path) -> bool:
        """Write the histogram as figure, or its counts as CSV, by the suffix."""
        return self._said(
            "The histogram was not saved",
            lambda: write_histogram(Path(path), self._histogram, self._document.name),
            f"Histogram saved to {path}",
        )

    def ask_convergence(self, write: Callable[[Path], object]) -> None:
        """Ask where the charts of convergence go and have them written."""
        path = ask_convergence(self._parent, self._stem)
        if path:
            self.convergence(path, write)

    def convergence(self, path: str | Path, write: Callable[[Path], object]) -> bool:
        """Have the charts of convergence written, as figure or CSV by the suffix."""
        return self._said("The charts were not saved", lambda: write(Path(path)), f"Convergence saved to {path}")

    def ask_comparison(self, comparison: Comparison) -> None:
        """Ask where the table of methods goes and write it."""
        path = ask_comparison(self._parent, self._stem)
        if path:
            self.comparison(path, comparison)

    def comparison(self, path: str | Path, comparison: Comparison) -> bool:
        """Write the table of methods as CSV, Markdown, LaTeX or JSON, by the suffix."""
        return self._said(
            "The table was not saved",
            lambda: write_comparison(Path(path), comparison.record()),
            f"Table of {counted(len(comparison.results), 'method')} saved to {path}",
        )

    @property
    def _stem(self) -> str:
        return self._document.path.stem if self._document.path else "mesh"

    def _said(self, failure: str, act: Callable[[], object], success: str) -> bool:
        """Do something and say that it is done, or, under the title `failure`, why it is not."""
        try:
            act()
        except HexmendError as error:
            self._messages.show_error(failure, str(error))
            return False
        self._messages.show_info(success)
        return True
