"""Tables of the mouse and key controls of the view, and of all actions with their keys."""

from __future__ import annotations

from collections.abc import Iterable
from html import escape

from PySide6.QtWidgets import QDialog, QLineEdit, QTextBrowser, QVBoxLayout, QWidget

from hexmend_app.feature import MENUS, Action
from hexmend_app.theme.palette import MUTED
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import on_theme_change, set_help
from hexmend_app.translation import tr

#: Mouse and key controls of the view.
VIEW = (
    ("Rotate", "drag, arrow keys"),
    ("Zoom", "wheel, right drag, + and −"),
    ("Pan", "middle drag, Shift+drag, Shift+arrow keys"),
    ("Select a hex and its nearest node", "click"),
    ("Hide a hex", "Ctrl+click"),
    ("Set the centre of rotation", "double click"),
    ("Open the context menu", "right click"),
)


def tables(actions: Iterable[Action]) -> list[tuple[str, list[tuple[str, str, str]]]]:
    """Return titles with rows of (name, keys, help): first the view, then each menu."""
    actions = list(actions)
    found = [(tr("In the view"), [(tr(name), tr(keys), "") for name, keys in VIEW])]
    for menu in (*MENUS, ""):
        rows = [(name_of(action), action.keys, action.help) for action in actions if action.menu == menu]
        if rows:
            title = " › ".join(map(tr, menu.split("/"))) if menu else tr("Not in a menu")
            found.append((title, rows))
    return found


def name_of(action: Action) -> str:
    """Return the text of an action without ampersand and ellipsis."""
    return action.text.replace("&", "").rstrip("…")


class KeysPage(QDialog):
    """List of every action with its keys, and a text field that filters it."""

    def __init__(self, actions: Iterable[Action], parent: QWidget | None = None):
        super().__init__(parent)
        self.setWindowTitle(tr("Mouse and keys"))
        self._tables = tables(actions)
        self._field = QLineEdit()
        self._field.setPlaceholderText(tr("Filter by name, keys or help"))
        self._field.setClearButtonEnabled(True)
        set_help(self._field, tr("Filter"), tr("Show only the entries whose name, keys or help contain these words."))
        self._page = QTextBrowser()
        set_help(self._page, tr("Mouse and keys"), "")
        fill(QVBoxLayout(self), self._field, self._page)
        self._field.textChanged.connect(self._fill)
        on_theme_change(self, self._fill)
        self.resize(640, 620)

    def text(self) -> str:
        """Return the list as plain text."""
        return self._page.toPlainText()

    def _fill(self, *_: object) -> None:
        words = self._field.text().lower().split()
        parts = []
        for title, rows in self._tables:
            matches = [row for row in rows if all(word in " ".join(row).lower() for word in words)]
            if matches:
                parts.append(f"<tr><td colspan=2><br><b>{escape(title)}</b></td></tr>")
                parts += [_row(*row) for row in matches]
        self._page.setHtml(f"<table width='100%' cellspacing=0 cellpadding=2>{''.join(parts)}</table>")


def _row(name: str, keys: str, help: str) -> str:
    explanation = f"<br><small style='color:{MUTED}'>{escape(help)}</small>" if help else ""
    shown = escape(keys).replace(" ", "&nbsp;") if len(keys) < 24 else escape(keys)
    return f"<tr><td>{escape(name)}{explanation}</td><td align=right><b>{shown}</b></td></tr>"
