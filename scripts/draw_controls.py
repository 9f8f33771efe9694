"""Draw the images of the style sheet, resources/controls/THEME/NAME.svg; a test checks that they are up to date.

Use: python scripts/draw_controls.py
"""

from __future__ import annotations

from pathlib import Path

from hexmend_app.theme.palette import AMBER, BLUE, FAINT, MUTED, ON_ACCENT, TEXT, WORSE, Role

FOLDER = Path(__file__).resolve().parents[1] / "resources" / "controls"

_UP, _DOWN, _LEFT, _RIGHT = "M2.5 8 6 4.5 9.5 8", "M2.5 4.5 6 8 9.5 4.5", "M8 2.5 4.5 6 8 9.5", "M4.5 2.5 8 6 4.5 9.5"
_CHECK, _DASH, _DOT = "M2 6.3 4.8 9 10 3.2", "M2.5 6h7", "M6 6h0"
_FOLDER = "M3.5 6.5v12h17V8.5H12l-2-2.5H3.5z"

#: Images of 12 pixels: line, width of the pen, colour.
SMALL: dict[str, tuple[str, float, Role]] = {
    "up": (_UP, 1.4, MUTED),
    "down": (_DOWN, 1.4, MUTED),
    "left": (_LEFT, 1.4, MUTED),
    "right": (_RIGHT, 1.4, MUTED),
    "up-faint": (_UP, 1.4, FAINT),
    "down-faint": (_DOWN, 1.4, FAINT),
    "check": (_CHECK, 1.8, ON_ACCENT),
    "check-faint": (_CHECK, 1.8, FAINT),
    "dash": (_DASH, 1.8, ON_ACCENT),
    "dash-faint": (_DASH, 1.8, FAINT),
    "dot": (_DOT, 5.0, ON_ACCENT),
    "dot-faint": (_DOT, 5.0, FAINT),
    "close": ("M2.5 2.5l7 7M9.5 2.5l-7 7", 1.2, MUTED),
    "float": ("M4.5 1.5h6v6M10.2 1.8 5 7M7.5 10.5h-6v-6", 1.2, MUTED),
}

#: Images of 24 pixels, of dialogs.
LARGE: dict[str, tuple[str, float, Role]] = {
    "information": ("M12 2.5a9.5 9.5 0 1 0 0 19a9.5 9.5 0 1 0 0-19zM12 11v6M12 7.2v.1", 2.0, BLUE),
    "question": (
        "M12 2.5a9.5 9.5 0 1 0 0 19a9.5 9.5 0 1 0 0-19zM9.2 9.5a2.8 2.8 0 1 1 4.2 2.4c-.9.5-1.4 1-1.4 2M12 17.2v.1",
        2.0,
        BLUE,
    ),
    "warning": ("M12 3.5 22 20.5H2zM12 10v4.5M12 17.4v.1", 2.0, AMBER),
    "critical": ("M8 2.5h8l5.5 5.5v8L16 21.5H8L2.5 16V8zM8.8 8.8l6.4 6.4M15.2 8.8l-6.4 6.4", 2.0, WORSE),
    "new-folder": (f"{_FOLDER}M12 11v5M9.5 13.5h5", 1.6, TEXT),
    "list": ("M4 6h7M4 12h7M4 18h7M14 6h6M14 12h6M14 18h6", 1.8, TEXT),
    "details": ("M4 6h16M4 12h16M4 18h16", 1.8, TEXT),
}


def images() -> dict[str, str]:
    """Return the SVG of each image by its path in the folder."""
    return {
        f"{theme}/{name}.svg": _svg(size, line, width, role.of(theme == "dark"))
        for theme in ("light", "dark")
        for size, table in ((12, SMALL), (24, LARGE))
        for name, (line, width, role) in table.items()
    }


def _svg(size: int, line: str, width: float, colour: str) -> str:
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{size}" height="{size}" viewBox="0 0 {size} {size}">'
        f'<path d="{line}" fill="none" stroke="{colour}" stroke-width="{width:g}" stroke-linecap="round"'
        ' stroke-linejoin="round"/></svg>\n'
    )


if __name__ == "__main__":
    for path, text in images().items():
        (FOLDER / path).parent.mkdir(parents=True, exist_ok=True)
        (FOLDER / path).write_text(text, encoding="utf-8")
