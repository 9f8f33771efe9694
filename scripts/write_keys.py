"""Write docs/reference/keys.md from the actions that features declare; a test checks that it is up to date.

Use: QT_QPA_PLATFORM=offscreen python scripts/write_keys.py
"""

from __future__ import annotations

from pathlib import Path

from hexmend_app.shell.keys import as_markdown
from hexmend_app.shell.start.program import application
from hexmend_app.shell.window import Window

PAGE = Path(__file__).resolve().parents[1] / "docs" / "reference" / "keys.md"

if __name__ == "__main__":
    app = application()
    window = Window()
    window.build_features()
    PAGE.write_text(as_markdown(window.menus.declared()), encoding="utf-8")
