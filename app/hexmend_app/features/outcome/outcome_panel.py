"""Panel of a run's outcome: reason of the end, remaining bad hexes, and suggestions."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape

import numpy as np
from PySide6.QtCore import Qt, Signal
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
from hexmend_app.theme.palette import AMBER, INVERTED_TEXT, TEXT, WORSE
from hexmend_app.theme.spacing import clear, fill
from hexmend_app.theme.style import bold, icon, note, set_help, show_text, tint
from hexmend_app.translation import tr
from hexmend_app.widgets.form_grid import scrolled
from hexmend_app.widgets.link_label import LinkLabel
from hexmend_app.widgets.wording import counted, with_minus

_HINT = (
    "No run has finished yet. After a run, this panel shows why it stopped, the remaining bad hexes, and suggestions."
)
#: Maximum number of hexes that are listed by number; the others are counted.
_MAX_LISTED = 24


class OutcomePanel(QWidget):
    """Explains the end of a run.

    Signals
    -------
    suggestion_chosen(int)
        The user selected this suggestion, counted from 0.
    show_requested(list)
        The user asked to isolate these hexes.
    visit_requested(list)
        The user asked to isolate these hexes and zoom to them.
    chosen(int)
        The user selected this hex.
    """

    suggestion_chosen = Signal(int)
    show_requested = Signal(list)
    visit_requested = Signal(list)
    chosen = Signal(int)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._busy = False
        self._hint = note(tr(_HINT))
        self._hint.setAlignment(Qt.AlignmentFlag.AlignCenter)
        self._hint.setMargin(24)
        self._title, self._reason, self._state, self._regressions = QLabel(), *(self._text() for _ in range(3))
        self._title.setFont(bold(self._title.font()))
        self._locked = _HexList(tr("Locked"), tr("that fixed nodes alone keep inverted"))
        self._unlocked = _HexList(tr("Inverted"), tr("that are inverted but not locked"))
        self._surface = self._text()
        self._limiting = _HexList(tr("Limiting"), tr("that limit the minimum scaled Jacobian"))
        self._locked_below = _HexList(
            tr("Fixed corner"),
            tr("whose worst corner has only fixed nodes"),
            tr("the hexes limited by fixed corners"),
        )
        self._hex_lists = (self._locked, self._unlocked, self._limiting, self._locked_below)
        for hex_list in self._hex_lists:
            hex_list.chosen.connect(self.chosen)
            request = self.visit_requested if hex_list is self._limiting else self.show_requested
            hex_list.show_requested.connect(request)
        self._suggestions_title = QLabel(tr("Suggestions"))
        self._suggestions_title.setFont(self._title.font())
        self._no_suggestion = note()
        self.view_note = note("", AMBER)
        self.view_note.hide()
        self._suggestions = QGridLayout()
        self._suggestions.setColumnStretch(0, 1)
        self._suggestions.setVerticalSpacing(8)
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
        page = QWidget()
        summary = (self._title, self.view_note, self._reason, self._state, self._regressions)
        suggestions = (self._suggestions_title, self._no_suggestion, self._suggestions)
        parts = (*summary, *self._hex_lists, self._surface, *suggestions)
        fill(QVBoxLayout(page), *parts, None, margins=(8, 8, 8, 8))
        return scrolled(page)

    def show_hint(self, hint: str = "") -> None:
        """Show a hint instead of an outcome; by default what this panel is for."""
        self._hint.setText(hint or tr(_HINT))
        self._stack.setCurrentIndex(0)

    def show_advice(self, title: str, advice: Advice, ids: np.ndarray | None = None) -> None:
        """Explain the end of a run; `ids` (m,) are the numbers of the hexes in the file, if it has some."""
        self._title.setText(title)
        self._reason.setText(advice.reason)
        self._state.setText(with_minus(advice.state))
        tint(self._state, INVERTED_TEXT if advice.locked.size or advice.unlocked.size else TEXT)
        show_text(self._regressions, with_minus(advice.regressions))
        tint(self._regressions, WORSE)
        self._locked.show_hexes(advice.locked, ids)
        self._unlocked.show_hexes(advice.unlocked, ids)
        self._limiting.show_hexes(advice.limiting, ids)
        self._locked_below.show_hexes(advice.locked_below, ids)
        show_text(self._surface, advice.surface)
        self._no_suggestion.setText(advice.no_suggestion)
        self._show_suggestions(advice.suggestions)
        self._stack.setCurrentIndex(1)

    def set_busy(self, busy: bool) -> None:
        """Disable the suggestions during a run and while a mesh is being opened."""
        self._busy = busy
        for button in self._buttons:
            button.setEnabled(not busy)

    def _show_suggestions(self, suggestions: Sequence[Suggestion]) -> None:
        clear(self._suggestions)
        self._buttons = []
        self._suggestions_title.setVisible(bool(suggestions or self._no_suggestion.text()))
        self._no_suggestion.setVisible(not suggestions and bool(self._no_suggestion.text()))
        before: QWidget = self._locked_below.button
        for index, suggestion in enumerate(suggestions):
            text = self._text()
            text.setTextFormat(Qt.TextFormat.RichText)
            text.setText(f"<b>{escape(suggestion.title)}.</b> {escape(suggestion.text)}")
            button = QPushButton(tr("Select"))
            set_help(button, tr("Select: {title}", title=suggestion.title), _selection_help(suggestion))
            button.clicked.connect(lambda _=False, index=index: self.suggestion_chosen.emit(index))
            self._suggestions.addWidget(text, index, 0)
            self._suggestions.addWidget(button, index, 1, Qt.AlignmentFlag.AlignTop)
            self.setTabOrder(before, button)  # Qt adds new widgets at the end of the window's tab order
            self._buttons.append(button)
            before = button
        self.set_busy(self._busy)


class _HexList(QWidget):
    """Links to hexes, and a button that isolates them; hidden while the list is empty."""

    chosen = Signal(int)
    show_requested = Signal(list)

    def __init__(self, title: str, description: str, name: str = "", parent: QWidget | None = None):
        super().__init__(parent)
        self._title = title
        self._hexes: list[int] = []
        self._links = LinkLabel()
        self._links.setWordWrap(True)
        self._links.followed.connect(self.chosen)
        set_help(
            self._links,
            tr("{title} hexes", title=title),
            tr("Hexes {description}; click one to select it.", description=description),
        )
        self.button = QPushButton(icon("eye-outline"), tr("Show"))
        self.button.clicked.connect(lambda: self.show_requested.emit(self._hexes))
        set_help(
            self.button,
            tr("Show {hexes}", hexes=name or tr("the {title} hexes", title=title.lower())),
            tr(
                "Show only the hexes {description}, and their neighbours; Esc shows all hexes again.",
                description=description,
            ),
        )
        row = fill(QHBoxLayout(self), (self._links, 1), margins=(0, 0, 0, 0))
        row.addWidget(self.button, 0, Qt.AlignmentFlag.AlignTop)

    def show_hexes(self, hexes: np.ndarray, ids: np.ndarray | None) -> None:
        """List hexes (k,) by number, with their numbers in the file if `ids` (m,) gives them."""
        self._hexes = hexes.tolist()
        links = ", ".join(f'<a href="{h}">{h}</a>' for h in self._hexes[:_MAX_LISTED])
        more = len(self._hexes) - _MAX_LISTED
        others = f" and {counted(more, 'other')}" if more > 0 else ""
        of_file = "" if ids is None else ", ".join(map(str, ids[hexes[:_MAX_LISTED]].tolist()))
        text = f"{self._title}: {links}{others}"
        self._links.setText(tr("{text} (in the file {ids})", text=text, ids=of_file) if of_file else text)
        self.setVisible(bool(self._hexes))


def _selection_help(suggestion: Suggestion) -> str:
    effects = []
    if suggestion.undo:
        effects.append(tr("go back to the mesh before the run"))
    if suggestion.unpin.size:
        effects.append(tr("unpin {nodes}", nodes=counted(int(suggestion.unpin.size), "node")))
    if suggestion.widen:
        effects.append(tr("unpin the nodes around the inverted hexes"))
    if suggestion.rules is not None:
        effects.append(tr("change the rules of motion"))
    effects.append(tr("set the method and its parameters"))
    return tr("{effects}. Run (F5) starts it.", effects=", ".join(effects).capitalize())
