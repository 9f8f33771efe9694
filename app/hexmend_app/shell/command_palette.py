"""Command palette: finds commands, panels, methods, and metrics to colour by, by parts of their names."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import partial
from typing import TYPE_CHECKING

from PySide6.QtCore import Qt
from PySide6.QtGui import QAction, QBrush, QColor, QKeyEvent, QKeySequence
from PySide6.QtWidgets import QDialog, QHeaderView, QLineEdit, QTreeWidget, QTreeWidgetItem, QVBoxLayout, QWidget

from hexmend.run import StoppingCriteria
from hexmend.run.recipe import Stage
from hexmend.smoothers import METHODS
from hexmend_app.feature import Panel
from hexmend_app.picture.colours import colour_quantities
from hexmend_app.shell.panels.docks import Docks
from hexmend_app.theme.palette import MUTED
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import on_theme_change, set_help, small_label
from hexmend_app.translation import tr

if TYPE_CHECKING:
    from hexmend_app.state.session.session import Session

#: Keys that move in the list while the text field has the focus.
_MOVES = (Qt.Key.Key_Up, Qt.Key.Key_Down, Qt.Key.Key_PageUp, Qt.Key.Key_PageDown)

_WIDTH = 590


class _Field(QLineEdit):
    """Text field whose arrow keys move in a list."""

    def __init__(self, tree: QTreeWidget):
        super().__init__()
        self._tree = tree

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Pass arrow keys to the list."""
        if event.key() in _MOVES:
            self._tree.keyPressEvent(event)
        else:
            super().keyPressEvent(event)


class CommandPalette(QDialog):
    """Dialog that finds actions by name, best match first, and triggers them.

    Parameters
    ----------
    entries : iterable of QAction
        Their status tips are their help, and their properties `within` are their menus or kinds, such as "Method".
    """

    def __init__(self, entries: Iterable[QAction], parent: QWidget | None = None):
        super().__init__(parent)
        self.setObjectName("command_palette")
        self.setWindowTitle(tr("Commands"))
        self.setWindowFlag(Qt.WindowType.FramelessWindowHint)
        self._entries = list(entries)
        self._found: list[QAction] = []
        self._list = QTreeWidget()
        self._field = _Field(self._list)
        self._field.setPlaceholderText(tr("Find a command, panel, method or metric"))
        set_help(self._field, tr("Command"), tr("Type parts of its name in any order; Enter runs the selected entry."))
        self._list.setColumnCount(2)
        self._list.setHeaderHidden(True)
        self._list.setRootIsDecorated(False)
        self._list.setUniformRowHeights(True)
        self._list.setAccessibleName(tr("Commands"))
        self._list.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self._list.header().setStretchLastSection(False)
        self._list.header().setSectionResizeMode(0, QHeaderView.ResizeMode.Stretch)
        self._list.header().setSectionResizeMode(1, QHeaderView.ResizeMode.ResizeToContents)
        self._nothing = small_label(tr("No matches."))
        fill(QVBoxLayout(self), self._field, self._list, self._nothing, margins=(8, 8, 8, 8))
        self.resize(_WIDTH, 380)
        self._field.textChanged.connect(self._fill)
        self._field.returnPressed.connect(self._run_entry)
        self._list.itemClicked.connect(self._run_entry)
        on_theme_change(self, self._fill)

    def titles(self) -> list[str]:
        """Return the titles of the listed entries, best match first."""
        return [title_of(entry) for entry in self._found]

    def _fill(self, *_: object) -> None:
        self._found = ranked(self._entries, self._field.text())
        self._list.clear()
        self._list.addTopLevelItems([_item(entry) for entry in self._found])
        self._list.setCurrentItem(self._list.topLevelItem(0))
        self._nothing.setVisible(not self._found)

    def _run_entry(self) -> None:
        at = self._list.indexOfTopLevelItem(self._list.currentItem()) if self._found else -1
        if at >= 0 and self._found[at].isEnabled():
            self.accept()
            self._found[at].trigger()


def _item(entry: QAction) -> QTreeWidgetItem:
    keys = entry.shortcut().toString(QKeySequence.SequenceFormat.NativeText)
    item = QTreeWidgetItem([title_of(entry), keys])
    item.setIcon(0, entry.icon())
    item.setToolTip(0, entry.statusTip())
    item.setTextAlignment(1, Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
    item.setForeground(1, QBrush(QColor(str(MUTED))))
    item.setDisabled(not entry.isEnabled())
    return item


def name_of(entry: QAction) -> str:
    """Return the name of an action, with its state if it can be checked."""
    name = entry.text().replace("&", "")
    return f"{name}: {tr('on') if entry.isChecked() else tr('off')}" if entry.isCheckable() else name


def title_of(entry: QAction) -> str:
    """Return the menu or kind of an action, if it has one, and its name."""
    within = entry.property("within")
    return f"{within}: {name_of(entry)}" if within else name_of(entry)


def entry(name: str, run: Callable[[], object], help: str = "", kind: str = "") -> QAction:
    """Return an action that is in the palette alone."""
    action = QAction(name)
    action.setStatusTip(help)
    action.setProperty("within", kind)
    action.triggered.connect(lambda: run())
    return action


def command_entries(actions: Mapping[str, QAction]) -> Iterator[QAction]:
    """Yield actions, given by id, except those that open a panel, which has an entry itself."""
    yield from (action for id, action in actions.items() if not id.startswith("panel_"))


def panel_entries(docks: Docks, panels: Iterable[Panel]) -> Iterator[QAction]:
    """Yield an entry that shows each panel."""
    for panel in panels:
        if panel.id in docks.ids():
            yield entry(panel.title, partial(docks.show_panel, panel.id), panel.help, tr("Panel"))


def choice_entries(session: Session) -> Iterator[QAction]:
    """Yield entries that choose a method, with its last parameters, or a metric to colour by."""
    run_setup = session.run_setup
    stop = run_setup.stage.stop if run_setup.stage is not None else StoppingCriteria()
    if session.editable:
        for method in METHODS.values():
            stage = Stage(run_setup.smoother_of(method.name), stop)
            choose = partial(run_setup.choose, stage, tr("{title} selected: press Run.", title=tr(method.title)))
            yield entry(tr(method.title), choose, tr(method.help), tr("Method"))
    if session.document.is_open:
        for metric in colour_quantities().values():
            colour = partial(session.view.colour_by, metric.name)
            yield entry(tr(metric.title), colour, tr(metric.meaning), tr("Colour by"))


#: Words of names for words that other programs use.
SYNONYMS = {
    "animation": "film",
    "bad": "worst",
    "clip": "cut",
    "close": "quit",
    "color": "colour",
    "distance": "measure",
    "exit": "quit",
    "export": "save",
    "dark": "theme",
    "font": "letters",
    "gif": "film",
    "hotkeys": "keys",
    "image": "picture",
    "load": "open",
    "movie": "film",
    "light": "theme",
    "night": "theme",
    "optimise": "mend",
    "options": "settings",
    "preferences": "settings",
    "relax": "smooth",
    "revert": "undo",
    "ruler": "measure",
    "screenshot": "picture",
    "section": "cut",
    "shortcuts": "keys",
    "slice": "cut",
    "terminal": "console",
    "untangle": "mend",
    "video": "film",
    "wireframe": "edges",
}
_LEAST_LETTERS = 3


def _meant(word: str) -> str:
    """Return the word of names for a word of other programs, of which the first letters are enough."""
    known = (name for other, name in SYNONYMS.items() if len(word) >= _LEAST_LETTERS and other.startswith(word))
    return next(known, word)


def ranked(entries: Iterable[QAction], text: str) -> list[QAction]:
    """Return the entries that contain every word of a text, best match first; equal matches keep their order.

    Matches at the start of the name rank first, then matches at starts of words of the name, then of the title;
    after these, matches anywhere in the name, in the title, and in the help, and then those of words that other
    programs use. Commands that cannot be run now come last; they are left out without a text.
    """
    words = text.lower().split()
    meant = [_meant(word) for word in words]
    found = [one for one in entries if words or one.isEnabled()]
    ranks = ((one, min(_rank(one, words), 10 + _rank(one, meant))) for one in found)
    matches = [(not one.isEnabled(), rank, one) for one, rank in ranks if rank < math.inf]
    return [one for *_, one in sorted(matches, key=lambda match: match[:2])]


def _rank(entry: QAction, words: list[str]) -> float:
    """Return the rank of a match, 0 for the best; infinity if the entry does not match."""
    name, title = name_of(entry).lower(), title_of(entry).lower()
    if name.startswith(" ".join(words)):
        return 0
    for rank, text in enumerate((name, title), start=1):
        parts = re.split(r"[\s\-–(:,]+", text)
        if all(any(part.startswith(word) for part in parts) for word in words):
            return rank
    for rank, text in enumerate((name, title, f"{title} {entry.statusTip().lower()}"), start=3):
        if all(word in text for word in words):
            return rank
    return math.inf
