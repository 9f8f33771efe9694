"""The font of pictures; it comes with matplotlib, so that pictures look the same everywhere."""

from __future__ import annotations

from functools import cache
from pathlib import Path

#: Its name.
FAMILY = "DejaVu Sans"


@cache
def font_file(bold: bool = False) -> str:
    """Return the path of the font."""
    import matplotlib as mpl

    return str(Path(mpl.get_data_path()) / "fonts/ttf" / ("DejaVuSans-Bold.ttf" if bold else "DejaVuSans.ttf"))
