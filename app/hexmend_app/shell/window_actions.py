"""Actions of the window itself, panels, layout, command palette, keys and quit; and the page of all keys."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import partial
from html import escape
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QPoint, Qt
from PySide6.QtWidgets import QDialog, QLineEdit, QTextBrowser, QVBoxLayout, QWidget

from hexmend_app.feature import MENUS, Action, Panel, PanelPlace
from hexmend_app.shell.command_palette import CommandPalette, choice_entries, command_entries, panel_entries
from hexmend_app.theme.palette import MUTED
from hexmend_app.theme.spacing import fill
from hexmend_app.theme.style import on_theme_change, set_help
from hexmend_app.translation import tr

if TYPE_CHECKING:
    from hexmend_app.shell.panels.docks import Docks

#: Mouse and key controls of the view.
VIEW = (
    ("Rotate", "drag, arrow keys"),
    ("Zoom", "wheel, right drag, + and −"),
    ("Pan", "middle drag, Shift+drag, Shift+arrow keys"),
    ("Select a hex and its nearest node", "click"),
    ("Hide a hex", "Ctrl+click"),
    ("Set the centre of rotation", "double click"),
    ("Push the cutting plane", "drag its arrow, or the wheel over it"),
    ("Rotate the cutting plane", "drag its ring"),
    ("Open the context menu", "right click"),
)


def declare_actions(window: Any, panels: Sequence[Panel]) -> Iterator[Action]:
    """Yield the actions of the window, including one for each of the `panels` of all features."""
    yield from _panel_actions(window.docks, panels)
    yield from _layout_actions(window.docks)
    yield from _program_actions(window, panels)


def _panel_actions(docks: Docks, panels: Sequence[Panel]) -> Iterator[Action]:
    """Yield the actions that show and close each panel."""
    by_id = {panel.id: panel for panel in panels}
    for id in docks.ids():
        yield Action(
            id=f"panel_{id}",
            text=by_id[id].title,
            menu="View/Panels" if by_id[id].place is not PanelPlace.BAR else "View",
            section=0 if by_id[id].place is not PanelPlace.BAR else 3,
            help=by_id[id].help,
            handle=lambda on, id=id: docks.show_panel(id) if on else docks.close_panel(id),
            checked=partial(docks.is_open, id),
            needs_mesh=False,
        )


def _layout_actions(docks: Docks) -> Iterator[Action]:
    """Yield the actions for all panels together."""
    yield Action(
        id="panels",
        text=tr("Show only the &view"),
        menu="View",
        section=3,
        keys="Ctrl+Tab",
        icon="fullscreen",
        help=tr("Hide all panels, or show them again (Tab in the view)."),
        handle=lambda on: docks.set_hidden(on),
        checked=lambda: docks.hidden,
        needs_mesh=False,
        in_view=True,
    )
    yield Action(
        id="drawer",
        text=tr("Panels &below the view"),
        menu="View",
        section=3,
        keys="Ctrl+B",
        icon="dock-bottom",
        help=tr("Open or close the panels below the view."),
        handle=docks.set_drawer_open,
        checked=lambda: docks.drawer_open,
        needs_mesh=False,
    )
    yield Action(
        id="reset_layout",
        text=tr("De&fault layout"),
        menu="View/Panels",
        section=9,
        icon="dock-window",
        help=tr("Open and dock all panels in their default places."),
        handle=docks.reset,
        needs_mesh=False,
    )


def _program_actions(window: Any, panels: Sequence[Panel]) -> Iterator[Action]:
    """Yield the actions command palette, keys and quit."""
    yield Action(
        id="commands",
        text=tr("&Commands…"),
        menu="Help",
        keys="Ctrl+Shift+P",
        icon="magnify",
        help=tr("Find a command, panel, method or metric by name."),
        needs_mesh=False,
        handle=lambda: _show_palette(window, panels),
    )
    yield Action(
        id="keys",
        text=tr("&Mouse and keys"),
        menu="Help",
        keys="F1",
        icon="mouse",
        help=tr("List the mouse controls of the view and all keys."),
        needs_mesh=False,
        handle=lambda: _show_keys(window),
    )
    yield Action(
        id="quit",
        text=tr("&Quit"),
        menu="File",
        section=9,
        keys="Ctrl+Q",
        help=tr("Close the window."),
        needs_mesh=False,
        handle=window.close,
    )


def _show_palette(window: Any, panels: Sequence[Panel]) -> None:
    window.refresh()
    actions = {id: action for id, action in window.window_actions.items() if id != "commands"}
    entries = [*command_entries(actions), *panel_entries(window.docks, panels), *choice_entries(window.session)]
    palette = CommandPalette(entries, window)
    palette.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
    palette.move(window.mapToGlobal(QPoint((window.width() - palette.width()) // 2, 60)))
    palette.open()


def _show_keys(window: Any) -> None:
    page = KeysPage(window.menus.declared(), window)
    page.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
    page.show()


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
