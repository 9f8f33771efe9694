"""Why a run stopped, what it left, and what to try next."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape

import numpy as np
from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QFont
from PySide6.QtWidgets import (
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QStackedLayout,
    QVBoxLayout,
    QWidget,
)

from hexmend.advice import Advice, Suggestion
from hexmend_app.theme.style import AMBER, INVERTED_TEXT, TEXT, WORSE, icon, note, set_help, tint
from hexmend_app.widgets.link_label import LinkLabel
from hexmend_app.widgets.scrolled import scrolled
from hexmend_app.widgets.wording import counted

_HINT = "No run has ended yet. Here you will see why it stopped, which hexes are still inverted, and what to try next."
#: Elements that are named; of more, the rest is counted.
_NAMED = 24


class OutcomePanel(QWidget):
    """Explains the end of a run.

    Signals
    -------
    suggestion_chosen(int)
        The user wants to try this suggestion, counted from 0.
    show_requested(list)
        The user wants to see these elements, and nothing else.
    visit_requested(list)
        The same, and the camera goes where all of them are seen.
    chosen(int)
        The user wants to see this element.
    """

    suggestion_chosen = Signal(int)
    show_requested = Signal(list)
    visit_requested = Signal(list)
    chosen = Signal(int)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._busy = False
        self._hint = note(_HINT)
        self._hint.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self._hint.setMargin(24)
        self._title, self._reason, self._left, self._worse = QLabel(), *(self._text() for _ in range(3))
        font = QFont(self._title.font())
        font.setBold(True)
        self._title.setFont(font)
        self._locked = _Elements("Locked", "whose fixed nodes alone hold them in inversion")
        self._loose = _Elements("Inverted", "that are inverted, and not locked")
        self._surface = self._text()
        self._limiting = _Elements(
            "Limiting",
            "whose corners let the least scaled Jacobian rise no further, whatever moves, in one place or in several",
        )
        self._locked_below = _Elements(
            "Locked lower",
            "with a corner of fixed nodes alone that is lower than any that can be moved",
            "the hexes that are locked lower",
        )
        for elements in (self._locked, self._loose, self._limiting, self._locked_below):
            elements.chosen.connect(self.chosen)
        for elements in (self._locked, self._loose, self._locked_below):
            elements.show_requested.connect(self.show_requested)
        self._limiting.show_requested.connect(self.visit_requested)
        self._next = QLabel("What to try next")
        self._next.setFont(font)
        self._nothing = note()
        self._where = note("", AMBER)
        self._where.hide()
        self._rows = QGridLayout()
        self._rows.setColumnStretch(0, 1)
        self._rows.setVerticalSpacing(6)
        self._buttons: list[QPushButton] = []
        self._stack = QStackedLayout(self)
        self._stack.addWidget(self._hint)
        self._stack.addWidget(self._page())

    def _text(self) -> QLabel:
        label = QLabel()
        label.setWordWrap(True)
        label.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        return label

    def _page(self) -> QWidget:
        inside = QWidget()
        column = QVBoxLayout(inside)
        column.setContentsMargins(8, 6, 8, 6)
        column.setSpacing(6)
        heads = (self._title, self._where, self._reason, self._left, self._worse)
        elements = (self._locked, self._loose, self._limiting, self._locked_below)
        parts = (*heads, *elements, self._surface, self._next, self._nothing)
        for part in parts:
            column.addWidget(part)
        column.addLayout(self._rows)
        column.addStretch()
        return scrolled(inside)

    def show_none(self, hint: str = _HINT) -> None:
        """Say that nothing is known yet, and why."""
        self._hint.setText(hint)
        self._stack.setCurrentIndex(0)

    def say_where(self, sentence: str) -> None:
        """Say that what the view shows is not what the run left, and what it is instead; "" where it is just that."""
        self._where.setText(sentence)
        self._where.setVisible(bool(sentence))

    def show_advice(self, title: str, advice: Advice) -> None:
        """Explain the end of a run."""
        self._title.setText(title)
        self._reason.setText(advice.reason)
        self._left.setText(advice.state)
        tint(self._left, INVERTED_TEXT if advice.locked.size or advice.unlocked.size else TEXT)
        self._worse.setText(advice.regressions)
        self._worse.setVisible(bool(advice.regressions))
        tint(self._worse, WORSE)
        self._locked.show_elements(advice.locked)
        self._loose.show_elements(advice.unlocked)
        self._limiting.show_elements(advice.limiting)
        self._locked_below.show_elements(advice.locked_below)
        self._surface.setText(advice.surface)
        self._surface.setVisible(bool(advice.surface))
        self._nothing.setText(advice.no_suggestion)
        self._show_suggestions(advice.suggestions)
        self._stack.setCurrentIndex(1)

    def set_busy(self, busy: bool) -> None:
        """Say whether a run is under way or a mesh is being read, in which nothing else can be chosen."""
        self._busy = busy
        for button in self._buttons:
            button.setEnabled(not busy)

    def _show_suggestions(self, suggestions: Sequence[Suggestion]) -> None:
        while (item := self._rows.takeAt(0)) is not None:
            item.widget().hide()
            item.widget().deleteLater()
        self._buttons = []
        self._next.setVisible(bool(suggestions or self._nothing.text()))
        self._nothing.setVisible(not suggestions and bool(self._nothing.text()))
        before: QWidget = self._locked_below.button
        for at, one in enumerate(suggestions):
            text = self._text()
            text.setTextFormat(Qt.TextFormat.RichText)
            text.setText(f"<b>{escape(one.title)}.</b> {escape(one.text)}")
            button = QPushButton("Choose")
            set_help(button, f"Choose: {one.title}", _help_of_choice(one))
            button.clicked.connect(lambda _=False, at=at: self.suggestion_chosen.emit(at))
            self._rows.addWidget(text, at, 0)
            self._rows.addWidget(button, at, 1, Qt.AlignmentFlag.AlignTop)
            self.setTabOrder(before, button)  # Qt puts what is made later at the end of the whole window
            self._buttons.append(button)
            before = button
        self.set_busy(self._busy)


class _Elements(QWidget):
    """Some elements by their numbers, and a button that shows them; hidden while there are none."""

    chosen = Signal(int)
    show_requested = Signal(list)

    def __init__(self, title: str, which: str, called: str = "", parent: QWidget | None = None):
        super().__init__(parent)
        called = called or f"the {title.lower()} hexes"
        self._name = title
        self._elements: list[int] = []
        self._numbers = LinkLabel()
        self._numbers.setWordWrap(True)
        self._numbers.followed.connect(self.chosen)
        set_help(self._numbers, f"{title} hexes", f"Hexes {which}; a click goes there.")
        self.button = QPushButton(icon("eye-outline"), "Show them")
        self.button.clicked.connect(lambda: self.show_requested.emit(self._elements))
        set_help(
            self.button,
            f"Show {called}",
            f"Show nothing but the hexes {which}, and their neighbours; Esc brings back the rest.",
        )
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.addWidget(self._numbers, 1)
        row.addWidget(self.button, 0, Qt.AlignmentFlag.AlignTop)

    def show_elements(self, elements: np.ndarray) -> None:
        """Show these; without a signal."""
        self._elements = elements.tolist()
        links = ", ".join(f'<a href="{h}">{h:,}</a>' for h in self._elements[:_NAMED])
        more = len(self._elements) - _NAMED
        rest = f" and {counted(more, 'other')}" if more > 0 else ""
        self._numbers.setText(f"{self._name}: {links}{rest}")
        self.setVisible(bool(self._elements))


def _help_of_choice(one: Suggestion) -> str:
    first = []
    if one.undo:
        first.append("goes back to before the run")
    if one.unpin.size:
        first.append(f"unpins {counted(int(one.unpin.size), 'node')}")
    first.append("sets method and values in the panel, and runs nothing: Run (F5) does")
    return f"{', '.join(first).capitalize()}."
