"""Window that lists mouse controls and keys."""

from __future__ import annotations

from collections.abc import Iterable
from html import escape

from PySide6.QtWidgets import QDialog, QLineEdit, QTextBrowser, QVBoxLayout, QWidget

from hexmend_app.feature import Action
from hexmend_app.shell.keys import tables
from hexmend_app.theme.palette import MUTED
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import on_theme_change, set_help
from hexmend_app.translation import tr


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
