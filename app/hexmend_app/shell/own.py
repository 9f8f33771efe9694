"""What the window itself can do: show its panels, find every command, list every key, and go."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from PySide6.QtCore import QPoint, Qt

from hexmend_app.feature import Action, Panel, Place
from hexmend_app.shell.keys_page import KeysPage
from hexmend_app.shell.offers import choices, commands, panels_in
from hexmend_app.shell.palette import CommandPalette

if TYPE_CHECKING:
    from hexmend_app.shell.docks import Docks
    from hexmend_app.shell.window import Window


def own_actions(window: Window, panels: Sequence[Panel]) -> list[Action]:
    """The window's own actions, among them one for each panel that has a tab.

    Parameters
    ----------
    window : Window
    panels : sequence of Panel
        Of all features.
    """
    return [*_of_panels(window.docks, panels), *_of_layout(window.docks), *_of_program(window, panels)]


def _of_panels(docks: Docks, panels: Sequence[Panel]) -> list[Action]:
    """Show each panel, or close it."""
    by_id = {panel.id: panel for panel in panels}
    return [
        Action(
            id=f"panel_{id}",
            text=by_id[id].title,
            menu="View/Panels" if by_id[id].place is not Place.BELOW else "View",
            part=0 if by_id[id].place is not Place.BELOW else 3,
            help=by_id[id].help,
            handle=lambda on, id=id: docks.show_panel(id) if on else docks.close_panel(id),
            checked=lambda id=id: docks.is_open(id),
            needs_mesh=False,
        )
        for id in docks.ids()
    ]


def _of_layout(docks: Docks) -> list[Action]:
    """What room the panels have together."""
    return [
        Action(
            id="panels",
            text="Show the &view alone",
            menu="View",
            part=3,
            keys="Ctrl+Tab",
            icon="fullscreen",
            help="Hide all panels, or bring them back; Tab in the view does the same.",
            handle=lambda on: docks.set_hidden(on),
            checked=lambda: docks.hidden,
            needs_mesh=False,
            in_view=True,
        ),
        Action(
            id="drawer",
            text="Panels &below the view",
            menu="View",
            part=3,
            keys="Ctrl+B",
            icon="dock-bottom",
            help="Open or close the drawer below the view.",
            handle=lambda on: docks.drawer.set_folded(not on),
            checked=lambda: not docks.drawer.folded,
            needs_mesh=False,
        ),
    ]


def _of_program(window: Window, panels: Sequence[Panel]) -> list[Action]:
    """Find what there is, and go."""
    return [
        Action(
            id="commands",
            text="&Commands…",
            menu="Help",
            keys="Ctrl+Shift+P",
            icon="magnify",
            help="Find any command, panel, method, metric or setting by its name.",
            needs_mesh=False,
            handle=lambda: _show_palette(window, panels),
        ),
        Action(
            id="keys",
            text="&Mouse and keys",
            menu="Help",
            keys="F1",
            icon="mouse",
            help="List how the view is driven, and every key.",
            needs_mesh=False,
            handle=lambda: _show_keys(window),
        ),
        Action(
            id="quit",
            text="&Quit",
            menu="File",
            part=9,
            keys="Ctrl+Q",
            help="Close the window.",
            needs_mesh=False,
            handle=window.close,
        ),
    ]


def _show_palette(window: Window, panels: Sequence[Panel]) -> None:
    window.refresh()
    others = {id: action for id, action in window.window_actions.items() if id != "commands"}
    entries = [*commands(others), *panels_in(window.docks, panels), *choices(window.session)]
    palette = CommandPalette(entries, window)
    palette.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
    palette.move(window.mapToGlobal(QPoint((window.width() - palette.width()) // 2, 60)))
    palette.open()


def _show_keys(window: Window) -> None:
    page = KeysPage(window.menus.declared(), window)
    page.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
    page.show()
