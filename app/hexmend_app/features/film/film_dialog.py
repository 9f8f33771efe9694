"""Dialog that edits the options of a film."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtWidgets import (
    QCheckBox,
    QDialog,
    QDialogButtonBox,
    QFormLayout,
    QSpinBox,
    QVBoxLayout,
    QWidget,
)

from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import note, set_help
from hexmend_app.translation import tr
from hexmend_app.widgets.inputs.combo import ComboBox

#: Widths to choose from, in pixels.
WIDTHS = (640, 960, 1280, 1920, 2560)

#: Width of the histogram as a fraction of that of the film; height of caption and colour bar together, at least in
#: pixels and as a fraction of that of the film (see `hexmend_app.scene.page.layout`, which loads VTK).
CHART_WIDTH, STRIPS = 0.32, (38, 0.125)

#: Default limit of the number of frames: larger files often cannot be viewed where they are sent.
FRAMES = 60


@dataclass(frozen=True)
class FilmChoice:
    """Options of a film.

    Parameters
    ----------
    width : int
        Width in pixels; the height follows from the shape of the view.
    rate : int
        Frames per second.
    frames : int
        Largest number of frames.
    histogram : bool
        Show a histogram next to the mesh.
    before : bool
        Show the mesh before the run next to it.
    """

    width: int = 960
    rate: int = 10
    frames: int = FRAMES
    histogram: bool = False
    before: bool = False

    def size(self, view: tuple[int, int]) -> tuple[int, int]:
        """Return width and even height of the film in pixels for a view of some width and height.

        Each of two pictures has the shape of the view, so that nothing is cropped at their sides.

        >>> FilmChoice(960).size((1083, 441)), FilmChoice(960, before=True).size((1083, 441))
        ((960, 390), (960, 234))
        """
        height = self.width * view[1] / view[0]
        if self.before:
            height *= (1 - CHART_WIDTH * self.histogram) / 2
            height = max(height + STRIPS[0], height / (1 - STRIPS[1]))
        return self.width, round(height / 2) * 2


class FilmDialog(QDialog):
    """Dialog that edits the options of a film.

    Parameters
    ----------
    choice : FilmChoice
        Initial options.
    view : (width, height)
        Size of the 3D view in pixels.
    iterations : int
        Number of iterations of the run.
    """

    def __init__(self, choice: FilmChoice, view: tuple[int, int], iterations: int, parent: QWidget | None = None):
        super().__init__(parent)
        self.setWindowTitle(tr("Save film"))
        self._view = view
        self._size, self._rate, self._frames = ComboBox(), QSpinBox(), QSpinBox()
        for width in WIDTHS:
            self._size.addItem("", width)
        self._size.setCurrentIndex(max(0, self._size.findData(choice.width)))
        set_help(self._size, tr("Size"), tr("Width and height of the film, including caption and colour bar."))
        self._rate.setRange(1, 50)
        self._rate.setSuffix(tr(" frames per second"))
        self._rate.setValue(choice.rate)
        set_help(self._rate, tr("Rate"), tr("Iterations shown per second."))
        self._frames.setRange(2, 1000)
        self._frames.setSuffix(tr(" frames"))
        self._frames.setValue(choice.frames)
        set_help(self._frames, tr("Frames"), tr("Maximum number of frames. Longer runs are thinned out evenly."))
        self._histogram = QCheckBox(tr("Histogram next to the mesh"))
        self._histogram.setChecked(choice.histogram)
        set_help(self._histogram, tr("Histogram"), tr("Show the distribution of values next to the mesh."))
        self._before = QCheckBox(tr("Mesh before the run on the left"))
        self._before.setChecked(choice.before)
        set_help(self._before, tr("Before"), tr("Show the first iteration next to the others."))
        for box in (self._histogram, self._before):
            box.toggled.connect(self._show_sizes)
        self._show_sizes()
        form = QFormLayout()
        form.addRow(tr("Size"), self._size)
        form.addRow(tr("Rate"), self._rate)
        form.addRow(tr("At most"), self._frames)
        form.addRow("", self._histogram)
        form.addRow("", self._before)
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Cancel)
        buttons.addButton(tr("Save as…"), QDialogButtonBox.ButtonRole.AcceptRole)
        buttons.accepted.connect(self.accept)
        buttons.rejected.connect(self.reject)
        fill(
            QVBoxLayout(self),
            note(tr("{count:,} iterations, with the cut, colours and arrows of the view.", count=iterations + 1)),
            form,
            buttons,
        )

    def _show_sizes(self) -> None:
        for row, width in enumerate(WIDTHS):
            choice = FilmChoice(width, histogram=self._histogram.isChecked(), before=self._before.isChecked())
            width, height = choice.size(self._view)
            self._size.setItemText(row, tr("{width} × {height} pixels", width=width, height=height))

    def choice(self) -> FilmChoice:
        """Return the selected options."""
        return FilmChoice(
            self._size.currentData(),
            self._rate.value(),
            self._frames.value(),
            self._histogram.isChecked(),
            self._before.isChecked(),
        )
