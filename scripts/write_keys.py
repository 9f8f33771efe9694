"""Write docs/reference/keys.md from the actions that features declare; a test checks that it is up to date.

Use: QT_QPA_PLATFORM=offscreen python scripts/write_keys.py
"""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from hexmend_app.feature import Action
from hexmend_app.shell.start.program import application
from hexmend_app.shell.window import Window
from hexmend_app.shell.window_actions import tables

PAGE = Path(__file__).resolve().parents[1] / "docs" / "reference" / "keys.md"


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


if __name__ == "__main__":
    app = application()
    window = Window()
    window.build_features()
    PAGE.write_text(as_markdown(window.menus.declared()), encoding="utf-8")
