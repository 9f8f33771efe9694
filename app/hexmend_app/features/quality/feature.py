"""Quality of the mesh, at the start and now, in a strip over the view."""

from __future__ import annotations

import math
from collections.abc import Iterable
from html import escape

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QGuiApplication, QResizeEvent, QTextDocument
from PySide6.QtWidgets import QFrame, QHBoxLayout, QLabel, QSizePolicy, QVBoxLayout, QWidget

from hexmend.quality import SUMMARY_QUANTITIES, Summary
from hexmend.quantity import Quantity
from hexmend_app.feature import Action, Feature, Host
from hexmend_app.state.settings import settings
from hexmend_app.theme.palette import BETTER, BLUE, MUTED, TEXT, WORSE, Role
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import icon, on_theme_change, set_help, smaller, tabular, tool_button
from hexmend_app.translation import tr
from hexmend_app.widgets.overlay import Overlay
from hexmend_app.widgets.wording import figure

#: Figures of the line, in order.
FIGURES = tuple(SUMMARY_QUANTITIES[key] for key in ("inverted", "invalid", "q_min", "q_mean", "scaled_jacobian_min"))
#: Figures of the table; the quality of the best hex tells nothing about a mesh.
ROWS = tuple(quantity for quantity in SUMMARY_QUANTITIES.values() if quantity.key != "q_max")
#: Groups of hexes to which the present numbers in the table are links.
LINKS = {"inverted": "inverted", "locked_inverted": "locked", "invalid": "invalid"}
_GAP = "&nbsp;" * 5


class FeatureQuality(Feature):
    """Shows the quality of the mesh as it was opened and as it is now."""

    def __init__(self, host: Host):
        super().__init__(host)
        self.bar = QualityBar(host.dialog_parent)
        self.bar.isolate_requested.connect(self._isolate)
        self.bar.hide()

    def actions(self) -> Iterable[Action]:
        """Yield the actions that show the figures in the view and copy them."""
        yield Action(
            id="key_figures",
            text=tr("&Key figures"),
            menu="View",
            section=3,
            help=tr(
                "Show inverted and invalid hexes, q min, q mean and scaled Jacobian min in the view. Side views "
                "have captions."
            ),
            handle=self._set_bar,
            checked=settings.KEY_FIGURES.get,
        )
        yield Action(
            id="copy_figures",
            text=tr("Copy quality figures"),
            help=tr("Copy all quality figures, at the start and now, as a table for a spreadsheet."),
            handle=self._copy,
        )

    def canvas_ready(self) -> None:
        """Show the key figures in the view."""
        Overlay(self.bar, self.canvas.interactor, (0.0, 1.0))
        self._show_bar()

    def refresh(self) -> None:
        """Update the figures."""
        document = self.session.document
        if not document.is_open:
            return
        if self._seen.changed("figures", document.start, document.now):
            self.bar.set_summaries(document.start.summary, document.now.summary)
        if self.canvas is not None and self._seen.changed("views", document.start, self.session.side_views.all):
            self._show_bar()

    def _set_bar(self, on: bool) -> None:
        settings.KEY_FIGURES.set(on)
        self._show_bar()

    def _show_bar(self) -> None:
        """Show the key figures of a single view; the captions of several views have figures of their own."""
        self.bar.setVisible(settings.KEY_FIGURES.get() and not self.session.side_views.all)

    def _copy(self) -> None:
        document = self.session.document
        QGuiApplication.clipboard().setText(figures_text(document.start.summary, document.now.summary))

    def _isolate(self, kind: str) -> None:
        self.session.view.isolate_group(kind)


class QualityBar(QFrame):
    """Line such as "q min 0.4035 → 0.4841 ▲", in a narrow view without the values at the start; below it, the table.

    Signals
    -------
    isolate_requested(str)
        The user clicked the number of "inverted", "locked" or "invalid" hexes.
    """

    isolate_requested = Signal(str)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._summaries: tuple[Summary, Summary] | None = None
        self._preferred_width = 0
        self.setObjectName("quality_bar")
        self._label, self.table = self._make_label(tr("Key figures")), self._make_label(tr("Quality of the mesh"))
        self._label.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self.table.linkActivated.connect(self.isolate_requested)
        self.table.hide()
        self.all_button = tool_button("chevron-down", MUTED)
        self.all_button.setCheckable(True)
        self.all_button.setIconSize(QSize(14, 14))
        set_help(self.all_button, tr("All figures"), tr("Show all quality figures, at the start and now."))
        self.all_button.toggled.connect(self._expand)
        line = fill(QHBoxLayout(), (self._label, 1), self.all_button, spacing=4)
        self._column = fill(QVBoxLayout(self), line, self.table, margins=(8, 2, 4, 2), spacing=4)
        on_theme_change(self, self._show)

    def set_summaries(self, start: Summary, now: Summary) -> None:
        """Show the figures of the mesh at the start and now."""
        self._summaries = start, now
        self._show()

    @property
    def text(self) -> str:
        """The line as plain text."""
        document = QTextDocument()
        document.setHtml(self._label.text())
        return " ".join(document.toPlainText().split())

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Omit the values at the start where the line is too narrow for them, then the last figures."""
        super().resizeEvent(event)
        self._fit()

    def sizeHint(self) -> QSize:
        """Return the size with all figures: that of the table if it is shown, else of the line."""
        hint = super().sizeHint()
        if not self.all_button.isChecked():
            hint.setWidth(self._preferred_width + self._other_width())
        return hint

    def minimumSizeHint(self) -> QSize:
        """Return a size that fits any view."""
        return QSize(0, 0)

    def _make_label(self, name: str) -> QLabel:
        label = QLabel()
        label.setFont(tabular(smaller(label.font())))
        label.setTextFormat(Qt.TextFormat.RichText)
        label.setAccessibleName(name)
        return label

    def _expand(self, on: bool) -> None:
        self.all_button.setIcon(icon("chevron-up" if on else "chevron-down", MUTED))
        self.table.setVisible(on)
        self._show()

    def _show(self) -> None:
        """Show the figures, and let the overlay fit its size to them."""
        if self._summaries is None:
            return
        self._label.setAccessibleDescription(". ".join(_sentence(one, *self._values(one)) for one in FIGURES))
        self._set_line(len(FIGURES), with_start=True)
        self._preferred_width = self._label.sizeHint().width()
        if self.all_button.isChecked():
            self.table.setText(self._table_html())
        self.updateGeometry()
        self._fit()

    def _other_width(self) -> int:
        """Return the width of all except the line."""
        margins = self._column.contentsMargins() + self.contentsMargins()
        return margins.left() + margins.right() + self.all_button.sizeHint().width() + 4

    def _fit(self) -> None:
        if self._summaries is None:
            return
        space, shown = self.width() - self._other_width(), len(FIGURES)
        self._set_line(shown, with_start=space >= self._preferred_width)
        while shown > 1 and self._label.sizeHint().width() > space:
            shown -= 1
            self._set_line(shown, with_start=False)

    def _set_line(self, shown: int, with_start: bool) -> None:
        self._label.setText(_GAP.join(_html(one, *self._values(one), with_start) for one in FIGURES[:shown]))

    def _table_html(self) -> str:
        titles = ("", tr("start"), tr("now"), tr("change"))
        head = "".join(f'<td align="right" style="color: {MUTED}">{title}</td>' for title in titles)
        rows = "".join(_row_html(one, *self._values(one)) for one in ROWS)
        return f'<table cellpadding="2" cellspacing="0"><tr>{head}</tr>{rows}</table>'

    def _values(self, quantity: Quantity) -> tuple[float | None, float | None]:
        """Return a figure at the start and now; None for an infinite one."""
        start, now = self._summaries
        return getattr(start, quantity.key), getattr(now, quantity.key)


def figures_text(start: Summary, now: Summary) -> str:
    """Return all figures as tab-separated text with a title line, in full precision; infinite figures are empty."""
    rows = [(row.title, getattr(start, row.key), getattr(now, row.key)) for row in ROWS]
    lines = [("figure", "start", "now"), *rows]
    return "".join("\t".join("" if cell is None else str(cell) for cell in line) + "\n" for line in lines)


def sense(quantity: Quantity, start: float | None, now: float | None) -> int:
    """Return 1 if a figure is better than at the start, -1 if it is worse, 0 if it is written alike or is neither.

    >>> sense(FIGURES[0], 36, 0), sense(FIGURES[2], 0.5, 0.4), sense(FIGURES[2], 0.50001, 0.5)
    (1, -1, 0)
    """
    if figure(start) == figure(now):
        return 0
    before, after = (math.inf if value is None else value for value in (start, now))
    return quantity.better if after > before else -quantity.better


def _arrow(start: float | None, now: float | None) -> str:
    """Return an arrow up or down; "" if the figures are written alike."""
    if figure(start) == figure(now):
        return ""
    return "▼" if start is None or (now is not None and now < start) else "▲"


def _colour(quantity: Quantity, start: float | None, now: float | None) -> Role:
    change = sense(quantity, start, now)
    if not change and quantity.key in LINKS and now:
        return WORSE
    return {1: BETTER, -1: WORSE, 0: TEXT}[change]


def _html(quantity: Quantity, start: float | None, now: float | None, with_start: bool) -> str:
    """Return a figure of the line, with its value at the start and an arrow if it differs."""
    arrow = _arrow(start, now)
    before = f"{figure(start)} → " if arrow and with_start else ""
    title = f'<span style="color: {MUTED}">{_unbroken(f"{tr(quantity.label)} {before}")}</span>'
    value = _unbroken(f"{figure(now)} {arrow}".strip())
    return f'{title}<b style="color: {_colour(quantity, start, now)}">{value}</b>'


def _row_html(quantity: Quantity, start: float | None, now: float | None) -> str:
    """Return a row of the table; a positive number of bad hexes is a link."""
    arrow, colour = _arrow(start, now), _colour(quantity, start, now)
    change = "=" if not arrow else arrow if start is None or now is None else f"{arrow} {figure(abs(now - start))}"
    title = f"– {tr(quantity.label)}" if quantity.part_of else tr(quantity.title)
    present = figure(now)
    if quantity.key in LINKS and now:
        present = f'<a href="{LINKS[quantity.key]}" style="color: {BLUE}">{present}</a>'
    cells = "".join(f'<td align="right">&nbsp;&nbsp;{text}</td>' for text in (figure(start), present))
    last = f'<td align="right" style="color: {colour}">&nbsp;&nbsp;{change}</td>'
    return f"<tr><td>{_unbroken(title)}</td>{cells}{last}</tr>"


def _unbroken(text: str) -> str:
    """Return a text as HTML in one line."""
    return escape(text).replace(" ", "&nbsp;")


def _sentence(quantity: Quantity, start: float | None, now: float | None) -> str:
    """Return a figure as text for screen readers."""
    words = {1: tr("better than"), -1: tr("worse than"), 0: tr("as")}[sense(quantity, start, now)]
    values = {"title": tr(quantity.label), "now": figure(now), "words": words, "start": figure(start)}
    return tr("{title} {now}, {words} at the start: {start}", **values)
