"""Captions of compared views: names, figures, close buttons, and the choices of the wipe."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import QSignalBlocker, QSize, Qt, Signal
from PySide6.QtWidgets import QComboBox, QHBoxLayout, QLabel, QToolButton, QWidget

from hexmend_app.theme.palette import Role
from hexmend_app.theme.style import MUTED, WORSE, icon, set_help, smaller, tabular, tint
from hexmend_app.widgets.eliding_label import ElidingLabel
from hexmend_app.widgets.legend import Swatch
from hexmend_app.widgets.wording import figure

_CROSS = 11

#: Pixels of a row; where the screen's scale is 150 %, a multiple of four is whole pixels of the screen.
HEIGHT = 24


@dataclass(frozen=True, eq=False)
class Caption:
    """Contents of a view for its caption.

    Parameters
    ----------
    name : str
    q_min : float
    inverted : int
    colour : Role or None
        Of its distribution in the histogram; None where it is not there.
    """

    name: str
    q_min: float
    inverted: int
    colour: Role | None

    @property
    def figures(self) -> str:
        """Format the figures."""
        return f"q min {figure(self.q_min)} · {f'{self.inverted:,}' if self.inverted else 'none'} inverted"


class CaptionRow(QWidget):
    """Captions of one row of views, each at the top of its view.

    Parameters
    ----------
    over : QWidget
        Widget of the views, which reserves space for captions above each.

    Signals
    -------
    closed(int)
        The user closes the view of this number.
    """

    closed = Signal(int)

    def __init__(self, over: QWidget):
        super().__init__(over)
        self.setAutoFillBackground(True)
        self._row = QHBoxLayout(self)
        self._row.setContentsMargins(0, 0, 0, 0)
        self._row.setSpacing(0)
        self._shown: list[tuple] = []
        self._parts: list[_Entry] = []
        self.hide()

    def set_captions(self, captions: Sequence[Caption], first: int) -> None:
        """Show captions, of views from the number `first` on; that of number 0 cannot be closed."""
        shown = [(first, caption.name, caption.colour) for caption in captions]
        if shown != self._shown:
            self._shown = shown
            for part in self._parts:
                self._row.removeWidget(part)
                part.hide()
                part.deleteLater()  # its button is the one that was clicked
            self._parts = [self._part(caption, number) for number, caption in enumerate(captions, first)]
            for part in self._parts:
                self._row.addWidget(part, 1)
        for part, caption in zip(self._parts, captions, strict=True):
            part.say(caption)
        self.setVisible(bool(captions))

    def stand_at(self, share: float) -> None:
        """Move to a share of the parent's height from its top, at its full width."""
        over = self.parentWidget().size()
        self.setGeometry(0, round(share * over.height()), over.width(), HEIGHT)

    def _part(self, caption: Caption, number: int) -> _Entry:
        part = _Entry(caption)
        if number:
            cross = QToolButton()
            cross.setIcon(icon("close", MUTED))
            cross.setIconSize(QSize(_CROSS, _CROSS))
            cross.setAutoRaise(True)
            cross.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
            set_help(cross, f"Close the view of {caption.name}", f"Close the view of {caption.name}.")
            cross.clicked.connect(lambda: self.closed.emit(number))
            part.layout().addWidget(cross)
        return part


class WipeRow(QWidget):
    """Choices of the views on both sides of the wipe.

    Signals
    -------
    chosen(left, right)
        The user chose other views, by their numbers.
    """

    chosen = Signal(int, int)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        row = QHBoxLayout(self)
        row.setContentsMargins(6, 0, 6, 0)
        self._sides, self._figures = [], []
        for side in ("left", "right"):
            box, label = QComboBox(), _figures()
            set_help(box, f"View at the {side}", f"What is seen at the {side} of the edge that is dragged.")
            box.activated.connect(lambda _: self.chosen.emit(*(side.currentIndex() for side in self._sides)))
            self._sides.append(box)
            self._figures.append(label)
        (left, right), (its, others) = self._sides, self._figures
        for part, stretch in ((left, 0), (its, 1), (others, 1), (right, 0)):
            row.addWidget(part, stretch)
        self.setFixedHeight(HEIGHT + 4)
        others.setAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
        self.hide()

    def set_captions(self, captions: Sequence[Caption], chosen: tuple[int, int] | None) -> None:
        """List the views and the two that are chosen; None hides the row."""
        self.setVisible(chosen is not None)
        for box, label, at in zip(self._sides, self._figures, chosen or (), strict=False):
            with QSignalBlocker(box):
                box.clear()
                box.addItems([caption.name for caption in captions])
                box.setCurrentIndex(at)
            _say(label, captions[at])


class _Entry(QWidget):
    """A colour, a name and figures in one line."""

    def __init__(self, caption: Caption):
        super().__init__()
        row = QHBoxLayout(self)
        row.setContentsMargins(8, 0, 4, 0)
        row.setSpacing(5)
        if caption.colour is not None:
            row.addWidget(Swatch(caption.colour))
        name = QLabel(caption.name)
        font = name.font()
        font.setBold(True)
        name.setFont(font)
        row.addWidget(name)
        self._figures = _figures()
        row.addWidget(self._figures, 1)
        self.setFixedHeight(HEIGHT)

    def say(self, caption: Caption) -> None:
        """Show the present figures."""
        if self._figures.text() != caption.figures:
            _say(self._figures, caption)
            set_help(self, f"{caption.name}: {caption.figures}", "")


def _figures() -> ElidingLabel:
    label = ElidingLabel()
    label.setFont(tabular(smaller(label.font())))
    return label


def _say(label: ElidingLabel, caption: Caption) -> None:
    label.setText(caption.figures)
    label.setToolTip(caption.figures)
    tint(label, WORSE if caption.inverted else MUTED)
