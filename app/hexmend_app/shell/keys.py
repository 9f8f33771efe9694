"""Tables of the mouse and key controls of the view, and of all actions with their keys."""

from __future__ import annotations

from collections.abc import Iterable

from hexmend_app.feature import MENUS, Action
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


def as_markdown(actions: Iterable[Action]) -> str:
    """Return the page `docs/reference/keys.md`: the actions that have a key."""
    lines = [
        "# Mouse and keys",
        "",
        "The command palette (`Ctrl+Shift+P`) lists all actions, also those without a key.",
        "",
    ]
    for title, rows in tables(actions):
        if keyed := [f"| {name} | `{keys}` |" for name, keys, _ in rows if keys]:
            lines += [f"## {title}", "", "| action | keys |", "|---|---|", *keyed, ""]
    return "\n".join(lines)
