"""Take the picture of performance-window.md: ten million hexes in the window, cut.

Use: xvfb-run -s "-screen 0 1600x1000x24" python scripts/pictures/large.py FOLDER
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

from screenshots import close_window, cut_mesh, open_window, screenshot, wait_until_drawn

from hexmend.gallery import make
from hexmend.io import write

_HEXES = 10_000_000


def take_pictures(folder: Path) -> None:
    """Take the picture of a cut in the window."""
    with tempfile.TemporaryDirectory() as directory:
        path = Path(directory) / "five-side.vtkhdf"
        write(path, make("five-side", size=_HEXES, scramble=0.3))
        window = open_window(path, (1080, 640))
        window.session.view.set_handles(False)
        cut_mesh(window)
        wait_until_drawn(window)
        screenshot(window, folder / "large-rest.png")
        close_window(window)


if __name__ == "__main__":
    take_pictures(Path(sys.argv[1]))
