"""Bar in the view with the key figures of the mesh: at the start, now, and whether they are better."""

from __future__ import annotations

from html import escape
from typing import Any

from PySide6.QtCore import QSize, Qt
from PySide6.QtGui import QResizeEvent, QTextDocument
from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QSizePolicy, QWidget

from hexmend.quality import SUMMARY_QUANTITIES
from hexmend.quantity import Quantity
from hexmend_app.theme.palette import BETTER, MUTED, TEXT, WORSE, Role
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import on_theme_change, smaller, tabular
from hexmend_app.translation import tr
from hexmend_app.widgets.wording import figure

#: Figures of the bar, in order.
FIGURES = tuple(SUMMARY_QUANTITIES[key] for key in ("inverted", "invalid", "q_min", "q_mean", "scaled_jacobian_min"))
#: Smaller differences are those of rounding.
_ROUNDING = 1e-12
_GAP = "&nbsp;" * 5


class QualityBar(QFrame):
    """Line of the key figures, such as "q min 0.4035 → 0.4841 ▲"; in a narrow view, without those at the start."""

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._summaries: tuple[Any, Any] | None = None
        self._preferred = QSize()
        self.setObjectName("quality_bar")
        self._label = QLabel()
        self._label.setFont(tabular(smaller(self._label.font())))
        self._label.setTextFormat(Qt.TextFormat.RichText)
        self._label.setAccessibleName(tr("Key figures"))
        self._label.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self._layout = fill(QHBoxLayout(self), self._label, margins=(8, 4, 8, 4))
        on_theme_change(self, self._show)

    def set_summaries(self, start: Any, now: Any) -> None:
        """Show two summaries of `hexmend.quality.summarise`: at the start and now."""
        self._summaries = start, now
        self._show()

    @property
    def text(self) -> str:
        """The figures as plain text."""
        document = QTextDocument()
        document.setHtml(self._label.text())
        return " ".join(document.toPlainText().split())

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Omit the figures at the start where the bar is too narrow for them, then the last figures."""
        super().resizeEvent(event)
        self._fit()

    def sizeHint(self) -> QSize:
        """Return the size with all figures."""
        return self._preferred.grownBy(self._layout.contentsMargins()).grownBy(self.contentsMargins())

    def minimumSizeHint(self) -> QSize:
        """Return a size that fits any view."""
        return QSize(0, 0)

    def _show(self) -> None:
        """Show the figures, and let the overlay fit its size to them."""
        if self._summaries is None:
            return
        figures = self._figures()
        help = "".join(f"<p>{_html(*entry, True)}<br>{escape(tr(entry[0].help))}</p>" for entry in figures)
        self._label.setToolTip(f"<qt>{help}</qt>")
        self._label.setAccessibleDescription(". ".join(_sentence(*entry) for entry in figures))
        self._set_text(with_start=True)
        self._preferred = self._label.sizeHint()
        self.updateGeometry()
        self._fit()

    def _fit(self) -> None:
        if self._summaries is None:
            return
        margins = self._layout.contentsMargins()
        space, shown = self.contentsRect().width() - margins.left() - margins.right(), len(FIGURES)
        self._set_text(with_start=self.width() >= self.sizeHint().width())
        while shown > 1 and self._label.sizeHint().width() > space:
            shown -= 1
            self._set_text(shown, with_start=False)

    def _set_text(self, shown: int = len(FIGURES), *, with_start: bool) -> None:
        self._label.setText(_GAP.join(_html(*entry, with_start) for entry in self._figures()[:shown]))

    def _figures(self) -> list[tuple[Quantity, Any, Any]]:
        """Return the quantities with their values at the start and now."""
        start, now = self._summaries
        return [(one, getattr(start, one.key), getattr(now, one.key)) for one in FIGURES]


def sense(quantity: Quantity, start: float, now: float) -> int:
    """Return 1 if a figure is better than at the start, -1 if it is worse, else 0.

    >>> sense(FIGURES[0], 36, 0), sense(FIGURES[2], 0.5, 0.4), sense(FIGURES[2], 0.5, 0.5)
    (1, -1, 0)
    """
    change = quantity.better * (now - start)
    return 0 if abs(change) <= _ROUNDING else 1 if change > 0 else -1


def _html(quantity: Quantity, start: float, now: float, with_start: bool) -> str:
    """Return a figure as HTML, with its value at the start and an arrow if it differs."""
    change = sense(quantity, start, now)
    colour: Role = {1: BETTER, -1: WORSE, 0: TEXT}[change]
    if not change and quantity.key in ("inverted", "invalid") and now:
        colour = WORSE
    arrow = "" if not change else " ▲" if now > start else " ▼"
    before = f"{figure(start)} → " if change and with_start else ""
    title = f'<span style="color: {MUTED}">{_unbroken(f"{tr(quantity.label)} {before}")}</span>'
    return f'{title}<b style="color: {colour}">{_unbroken(f"{figure(now)}{arrow}")}</b>'


def _unbroken(text: str) -> str:
    """Return a text as HTML in one line."""
    return escape(text).replace(" ", "&nbsp;")


def _sentence(quantity: Quantity, start: float, now: float) -> str:
    """Return a figure as text for screen readers."""
    words = {1: tr("better than"), -1: tr("worse than"), 0: tr("as")}[sense(quantity, start, now)]
    values = {"title": tr(quantity.label), "now": figure(now), "words": words, "start": figure(start)}
    return tr("{title} {now}, {words} at the start: {start}", **values)
