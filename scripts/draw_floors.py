"""Draw docs/architecture-*.svg: the floors of core and app, as scripts/check_layers.py has them.

Use: python scripts/draw_floors.py [FOLDER]
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from html import escape
from pathlib import Path

import check_layers

ROOT = Path(__file__).resolve().parents[1]

_WIDTH, _HEIGHT, _GAP = 640, 30, 6
#: Colours of the floors from the bottom up, from the dark end of the program's colour map to the light one.
_GROUND, _ROOF = (0x2A, 0x5D, 0x78), (0x8F, 0xD0, 0x9B)


def floors() -> dict[str, Sequence[set[str]]]:
    """File names, and floors from the ground up."""
    return {"architecture-core.svg": check_layers.CORE, "architecture-app.svg": check_layers.APP}


def drawn(levels: Sequence[set[str]]) -> str:
    """A drawing as SVG: the ground at the bottom, each name in a box of its own."""
    height = len(levels) * (_HEIGHT + _GAP) + _GAP
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {_WIDTH} {height}" width="{_WIDTH}" height="{height}" '
        'font-family="DejaVu Sans, Verdana, sans-serif" font-size="14" text-anchor="middle">'
    ]
    for floor, names in enumerate(levels):
        y = height - (floor + 1) * (_HEIGHT + _GAP)
        width = (_WIDTH - _GAP) / len(names) - _GAP
        share = floor / (len(levels) - 1)
        fill = "#" + "".join(f"{round(a + share * (b - a)):02x}" for a, b in zip(_GROUND, _ROOF, strict=True))
        ink = "#ffffff" if share < 0.5 else "#1b1f2a"
        for k, name in enumerate(sorted(names)):
            x = _GAP + k * (width + _GAP)
            parts.append(f'<rect x="{x:g}" y="{y}" width="{width:g}" height="{_HEIGHT}" rx="4" fill="{fill}"/>')
            parts.append(f'<text x="{x + width / 2:g}" y="{y + 20}" fill="{ink}">{escape(name)}</text>')
    return "\n".join([*parts, "</svg>"]) + "\n"


def main(folder: Path) -> None:
    """Draw them all."""
    for name, levels in floors().items():
        (folder / name).write_text(drawn(levels), encoding="utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "docs" / "pictures")
