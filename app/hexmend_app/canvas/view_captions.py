"""Captions of compared views: names, figures, close buttons, and the view selectors of a wipe."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtWidgets import QHBoxLayout, QSizePolicy, QWidget

from hexmend_app.theme.palette import MUTED, WORSE, Role
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import bold, cross_button, set_help, smaller, tabular, tint
from hexmend_app.translation import tr
from hexmend_app.widgets.eliding_label import ElidingLabel
from hexmend_app.widgets.inputs.combo import ComboBox
from hexmend_app.widgets.legend import Swatch
from hexmend_app.widgets.wording import figure

#: Height of a row in pixels; with a screen scale of 150 %, a multiple of four gives whole device pixels.
HEIGHT = 24


def caption_height(widget: QWidget) -> int:
    """Return the height of a caption in the font of a widget, in pixels."""
    return max(HEIGHT, widget.fontMetrics().height() + 4)


@dataclass(frozen=True, eq=False)
class Caption:
    """Contents of the caption of a view.

    Parameters
    ----------
    name : str
    q_min : float
    inverted, invalid : int
    colour : Role or None
        Colour of the mesh in the histogram; None if it is not in the histogram.
    counts : tuple of (str, int)
        Names and numbers of hexes with special colours; empty for those that are invalid.
    """

    name: str
    q_min: float
    inverted: int
    invalid: int
    colour: Role | None
    counts: tuple[tuple[str, int], ...] = ()

    @property
    def figures(self) -> str:
        """Numbers of hexes with special colours, and the smallest q as text."""
        kinds = self.counts or (("inverted", self.inverted), ("invalid inside", self.invalid - self.inverted))
        counts = [f"{count:,} {tr(name)}" for name, count in kinds if count]
        return " · ".join([*(counts or [tr("none invalid")]), tr("q min {value}", value=figure(self.q_min))])


class CaptionRow(QWidget):
    """Captions of a row of views, each at the top of its view.

    Parameters
    ----------
    over : QWidget
        Widget of the views, which reserves space for the captions.

    Signals
    -------
    closed(int)
        The user closed the view with this number.
    """

    closed = Signal(int)

    def __init__(self, over: QWidget):
        super().__init__(over)
        self.setAutoFillBackground(True)
        self._row = fill(QHBoxLayout(self), margins=(0, 0, 0, 0), spacing=0)
        self._shown: list[tuple] = []
        self._parts: list[_Entry] = []
        self.hide()

    def set_captions(self, captions: Sequence[Caption], first: int) -> None:
        """Show the captions of views with numbers from `first`; view 0 cannot be closed."""
        shown = [(first, caption.name, caption.colour) for caption in captions]
        if shown != self._shown:
            self._shown = shown
            for part in self._parts:
                self._row.removeWidget(part)
                part.hide()
                part.deleteLater()  # not immediately, as its button may be the sender of this change
            self._parts = [self._part(caption, number) for number, caption in enumerate(captions, first)]
            for part in self._parts:
                self._row.addWidget(part, 1)
        for part, caption in zip(self._parts, captions, strict=True):
            part.set_figures(caption)
        self.setVisible(bool(captions))

    def place_at(self, share: float, width: int) -> None:
        """Place the row at a fraction of the height of the parent from its top, with a width in pixels."""
        self.setGeometry(0, round(share * self.parentWidget().height()), width, caption_height(self))

    def _part(self, caption: Caption, number: int) -> _Entry:
        part = _Entry(caption)
        if number:
            cross = cross_button()
            help = tr("Close the view of {name}", name=caption.name)
            set_help(cross, help, help)
            cross.clicked.connect(lambda: self.closed.emit(number))
            part.layout().addWidget(cross)
        return part


class WipeRow(QWidget):
    """Selectors of the views on both sides of a wipe.

    Signals
    -------
    chosen(left, right)
        The user selected views, by their numbers.
    """

    chosen = Signal(int, int)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._sides, self._figures = list[ComboBox](), list[ElidingLabel]()
        for side in ("left", "right"):
            box, label = ComboBox(), _figures()
            set_help(
                box,
                tr("{side} view", side=side.capitalize()),
                tr("View on the {side} of the draggable edge", side=side),
            )
            box.activated.connect(lambda _: self.chosen.emit(*(side.currentIndex() for side in self._sides)))
            self._sides.append(box)
            self._figures.append(label)
        (left, right), (left_figures, right_figures) = self._sides, self._figures
        fill(QHBoxLayout(self), left, (left_figures, 1), (right_figures, 1), right, margins=(8, 0, 8, 0))
        self.setFixedHeight(caption_height(self) + 4)
        right_figures.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        self.hide()

    def set_captions(self, captions: Sequence[Caption], chosen: tuple[int, int] | None) -> None:
        """List the views and select two of them by number; None hides the row."""
        self.setVisible(chosen is not None)
        for box, label, at in zip(self._sides, self._figures, chosen or (), strict=False):
            with QSignalBlocker(box):
                box.clear()
                box.addItems([caption.name for caption in captions])
                box.setCurrentIndex(at)
            _show_figures(label, captions[at])


class _Entry(QWidget):
    """Caption of a view: colour, name and figures in a line."""

    def __init__(self, caption: Caption):
        super().__init__()
        name = ElidingLabel(caption.name)
        name.setFont(bold(name.font()))
        swatches = [] if caption.colour is None else [Swatch(caption.colour)]
        self._figures = _figures()
        self._figures.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Preferred)
        fill(QHBoxLayout(self), *swatches, name, (self._figures, 1), margins=(8, 0, 4, 0), spacing=4)
        self.setFixedHeight(caption_height(self))

    def set_figures(self, caption: Caption) -> None:
        """Update the figures."""
        if self._figures.text() != caption.figures:
            _show_figures(self._figures, caption)
            first = f"{caption.figures.split(' · ')[0]}…"  # is complete even if the name is long
            self._figures.setMinimumWidth(self._figures.fontMetrics().horizontalAdvance(first))
            set_help(self, f"{caption.name}: {caption.figures}", "")


def _figures() -> ElidingLabel:
    label = ElidingLabel()
    label.setFont(tabular(smaller(label.font())))
    return label


def _show_figures(label: ElidingLabel, caption: Caption) -> None:
    label.setText(caption.figures)
    label.setToolTip(caption.figures)
    tint(label, WORSE if caption.invalid else MUTED)
