"""Panel of a run's outcome: reason of the end, remaining bad hexes, and suggestions."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape

import numpy as np
from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QGridLayout, QLabel, QPushButton, QVBoxLayout, QWidget

from hexmend.advice import Advice, Suggestion
from hexmend_app.theme.palette import INVERTED_TEXT, TEXT, WORSE
from hexmend_app.theme.spacing import clear, fill
from hexmend_app.theme.style import on_theme_change, push_button
from hexmend_app.translation import tr
from hexmend_app.widgets.link_label import LinkLabel
from hexmend_app.widgets.wording import counted, with_minus

_HINT = "No run has finished yet. After a run, this says why it stopped, which bad hexes are left, and what to try."
#: Maximum number of hexes that are listed by number; the others are counted.
_MAX_LISTED = 24

#: Lists of hexes in `Advice`, with their titles and descriptions.
_LISTS = (
    ("locked", "Locked", "kept inverted by fixed nodes alone"),
    ("unlocked", "Inverted", "not locked"),
    ("limiting", "Limiting", "limit the minimum scaled Jacobian"),
    ("locked_below", "Fixed corner", "all nodes of the worst corner are fixed"),
)


class OutcomePanel(QWidget):
    """Explains the end of a run.

    Signals
    -------
    suggestion_chosen(int)
        The user selected this suggestion, counted from 0.
    show_requested(list)
        The user asked to isolate these hexes.
    chosen(int)
        The user selected this hex.
    """

    suggestion_chosen = Signal(int)
    show_requested = Signal(list)
    chosen = Signal(int)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._title, self._hint = "", tr(_HINT)
        self._advice: Advice | None = None
        self._ids: np.ndarray | None = None
        self._busy = False
        self.text = LinkLabel()
        self.text.setWordWrap(True)
        self.text.setAccessibleName(tr("Run summary"))
        self.text.followed.connect(self.chosen)
        self.text.linkActivated.connect(self._follow)
        self._suggestions = QGridLayout()
        self._suggestions.setColumnStretch(0, 1)
        self._suggestions.setVerticalSpacing(8)
        self._buttons: list[QPushButton] = []
        fill(QVBoxLayout(self), self.text, self._suggestions, margins=(8, 0, 8, 4))
        on_theme_change(self, self._show)

    def show_hint(self, hint: str = "") -> None:
        """Show a hint instead of an outcome; by default what this panel is for."""
        hint = hint or tr(_HINT)
        if self._advice is not None or hint != self._hint:
            self._advice, self._hint = None, hint
            self._show_suggestions(())
            self._show()

    def show_advice(self, title: str, advice: Advice, ids: np.ndarray | None = None) -> None:
        """Explain the end of a run; `ids` (m,) are the numbers of the hexes in the file, if it has some."""
        self._title, self._advice, self._ids = title, advice, ids
        self._show_suggestions(advice.suggestions)
        self._show()

    def set_busy(self, busy: bool) -> None:
        """Disable the suggestions during a run and while a mesh is being opened."""
        self._busy = busy
        for button in self._buttons:
            button.setEnabled(not busy)

    def _show(self) -> None:
        advice = self._advice
        if advice is None:
            self.text.setText(escape(self._hint))
            return
        bad = INVERTED_TEXT if advice.locked.size or advice.unlocked.size else TEXT
        lists = (_hexes_html(name, tr(title), tr(about), advice, self._ids) for name, title, about in _LISTS)
        suggests = advice.suggestions or advice.no_suggestion
        paragraphs = (
            f"<b>{escape(self._title)}</b>",
            escape(advice.reason),
            f'<span style="color: {bad}">{escape(with_minus(advice.state))}</span>',
            f'<span style="color: {WORSE}">{escape(with_minus(advice.regressions))}</span>' * bool(advice.regressions),
            *lists,
            escape(advice.surface),
            f"<b>{tr('Suggestions')}</b>" if suggests else "",
            "" if advice.suggestions else escape(advice.no_suggestion),
        )
        self.text.setText("".join(f'<p style="margin: 0 0 6px">{text}</p>' for text in paragraphs if text))

    def _show_suggestions(self, suggestions: Sequence[Suggestion]) -> None:
        clear(self._suggestions)
        self._buttons = []
        before: QWidget = self.text
        for index, suggestion in enumerate(suggestions):
            text = QLabel(f"<b>{escape(suggestion.title)}.</b> {escape(suggestion.text)}")
            text.setWordWrap(True)
            name = tr("Select: {title}", title=suggestion.title)
            button = push_button(tr("Select"), _selection_help(suggestion), name=name)
            button.clicked.connect(lambda _=False, index=index: self.suggestion_chosen.emit(index))
            self._suggestions.addWidget(text, index, 0)
            self._suggestions.addWidget(button, index, 1, Qt.AlignmentFlag.AlignTop)
            self.setTabOrder(before, button)  # Qt adds new widgets at the end of the window's tab order
            self._buttons.append(button)
            before = button
        self.set_busy(self._busy)

    def _follow(self, link: str) -> None:
        """Isolate the hexes of a list, whose name the link is."""
        hexes = getattr(self._advice, link, None)
        if hexes is not None:
            self.show_requested.emit(hexes.tolist())


def _hexes_html(name: str, title: str, about: str, advice: Advice, ids: np.ndarray | None) -> str:
    """Return links to the hexes of a list of the advice and to all of them, and their numbers in the file."""
    hexes = getattr(advice, name)
    if not hexes.size:
        return ""
    listed = hexes[:_MAX_LISTED]
    links = ", ".join(f'<a href="{h}">{h}</a>' for h in listed.tolist())
    more = hexes.size - listed.size
    others = tr(" and {others}", others=counted(more, "other")) if more else ""
    of_file = "" if ids is None else tr(" (in the file {ids})", ids=", ".join(map(str, ids[listed].tolist())))
    return f'{title} ({about}): {links}{others}{of_file} · <a href="{name}">{tr("Show")}</a>'


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
