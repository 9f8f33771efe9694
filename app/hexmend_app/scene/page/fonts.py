"""Font of pictures, which is shipped with matplotlib, so that pictures look the same on all machines."""

from __future__ import annotations

from functools import cache
from pathlib import Path

#: Name of the font.
FAMILY = "DejaVu Sans"


@cache
def font_file(bold: bool = False) -> str:
    """Return the path of the font file."""
    import matplotlib as mpl

    return str(Path(mpl.get_data_path()) / "fonts/ttf" / ("DejaVuSans-Bold.ttf" if bold else "DejaVuSans.ttf"))
