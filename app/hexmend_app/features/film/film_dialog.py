"""Asks what a film is to be like."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtWidgets import (
    QCheckBox,
    QComboBox,
    QDialog,
    QDialogButtonBox,
    QFormLayout,
    QSpinBox,
    QVBoxLayout,
    QWidget,
)

from hexmend_app.theme.style import note, set_help

#: Widths on offer, in pixels.
WIDTHS = (640, 960, 1280, 1920, 2560)

#: Most frames of a film unless the user says otherwise: more are not opened where they are sent to.
FRAMES = 60


@dataclass(frozen=True)
class FilmChoice:
    """Options of a film.

    Parameters
    ----------
    width : int
        In pixels; the height is that of the view.
    rate : int
        Frames a second.
    frames : int
        The most.
    histogram : bool
        Whether it stands beside.
    """

    width: int = 960
    rate: int = 10
    frames: int = FRAMES
    histogram: bool = False

    def size(self, view: tuple[int, int]) -> tuple[int, int]:
        """Width and height in pixels, both even, of a film of a view of so many.

        >>> FilmChoice(960).size((1083, 441))
        (960, 390)
        """
        return self.width, round(self.width * view[1] / view[0] / 2) * 2


class FilmDialog(QDialog):
    """Edits a choice.

    Parameters
    ----------
    choice : FilmChoice
        Shown first.
    view : (width, height)
        Of the 3D view, in pixels.
    iterations : int
        That there are.
    """

    def __init__(self, choice: FilmChoice, view: tuple[int, int], iterations: int, parent: QWidget | None = None):
        super().__init__(parent)
        self.setWindowTitle("Save a film of the run")
        self._size, self._rate, self._frames = QComboBox(), QSpinBox(), QSpinBox()
        for width in WIDTHS:
            self._size.addItem("{} × {} pixels".format(*FilmChoice(width).size(view)), width)
        self._size.setCurrentIndex(max(0, self._size.findData(choice.width)))
        set_help(self._size, "Size", "Width and height of the film, caption and colour bar included.")
        self._rate.setRange(1, 50)
        self._rate.setSuffix(" frames a second")
        self._rate.setValue(choice.rate)
        set_help(self._rate, "Rate", "How many iterations are shown in a second.")
        self._frames.setRange(2, 1000)
        self._frames.setSuffix(" frames")
        self._frames.setValue(choice.frames)
        set_help(self._frames, "Frames", "The most: of more iterations, some are left out evenly.")
        self._histogram = QCheckBox("Histogram next to the mesh")
        self._histogram.setChecked(choice.histogram)
        set_help(self._histogram, "Histogram", "How many hexes have what value, frame by frame.")
        form = QFormLayout()
        form.addRow("Size", self._size)
        form.addRow("Rate", self._rate)
        form.addRow("At most", self._frames)
        form.addRow("", self._histogram)
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Cancel)
        buttons.addButton("Save as…", QDialogButtonBox.ButtonRole.AcceptRole)
        buttons.accepted.connect(self.accept)
        buttons.rejected.connect(self.reject)
        column = QVBoxLayout(self)
        column.addWidget(note(f"{iterations + 1:,} iterations, drawn as the view shows them: cut, colours and arrows."))
        column.addLayout(form)
        column.addWidget(buttons)

    def choice(self) -> FilmChoice:
        """Return the options that the user chose."""
        return FilmChoice(
            self._size.currentData(), self._rate.value(), self._frames.value(), self._histogram.isChecked()
        )
