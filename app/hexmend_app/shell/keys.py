"""The page of mouse and keys: controls of the view, and every action with keys."""

from __future__ import annotations

from collections.abc import Iterable

from hexmend_app.feature import MENUS, Action

#: Mouse and key controls of the view.
VIEW = (
    ("Turn", "drag, arrow keys"),
    ("Zoom", "wheel, right drag, + and −"),
    ("Pan", "middle drag, Shift+drag, Shift+arrow keys"),
    ("Choose a hex and its nearest node", "click"),
    ("Dig a hex away", "Ctrl+click"),
    ("Centre of rotation", "double click"),
    ("What can be done there", "right click"),
)


def tables(actions: Iterable[Action]) -> list[tuple[str, list[tuple[str, str, str]]]]:
    """Titles with rows of (what, keys, help): the view first, then every menu with its actions.

    Parameters
    ----------
    actions : iterable of Action
    """
    actions = list(actions)
    found = [("In the view", [(topic, style, "") for topic, style in VIEW])]
    for menu in (*MENUS, ""):
        rows = [(words(one), one.keys, one.help) for one in actions if one.menu == menu]
        if rows:
            found.append((menu.replace("/", " › ") or "Elsewhere", rows))
    return found


def words(action: Action) -> str:
    """Text of an action without its ampersand."""
    return action.text.replace("&", "").rstrip("…")


def as_markdown(actions: Iterable[Action]) -> str:
    """The page for `docs/keys.md`."""
    parts = ["# Mouse and keys", "", "Written by `make docs` from what the features declare.", ""]
    for title, rows in tables(actions):
        parts += [f"## {title}", "", "| what | keys | |", "|---|---|---|"]
        parts += [f"| {subject} | {keys and f'`{keys}`'} | {help} |" for subject, keys, help in rows]
        parts.append("")
    return "\n".join(parts)
