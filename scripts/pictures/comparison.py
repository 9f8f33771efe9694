"""Take the pictures of docs/methods/compare.md, of gallery meshes.

Use: xvfb-run -s "-screen 0 1600x1000x24" python scripts/pictures/comparison.py FOLDER
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

from screenshots import (
    close_window,
    compress,
    cut_mesh,
    open_window,
    screenshot,
    set_method,
    wait_until,
    wait_until_drawn,
)

from hexmend.gallery import make
from hexmend.io import write
from hexmend_app.shell.window import Window
from hexmend_app.theme.theme_choice import ThemeChoice, choose

_SHOWN = ("laplacian", "getme", "mend")


def compare(window: Window) -> None:
    """Run the methods that are ticked by default, and cut the mesh open."""
    window.show_panel("compare")
    set_method(window, "mend", max_iterations=100)
    window.action("compare").trigger()
    wait_until(lambda: window.session.comparison.results and not window.session.comparison.busy)
    window.session.view.set_handles(False)
    cut_mesh(window)


def show(window: Window, *names: str) -> None:
    """Show the results in views."""
    for name in names:
        window.features["compare"].panel.model.view_toggled.emit(name, True)
        window.refresh()


def main(folder: Path) -> None:
    """Take all pictures of the page."""
    with tempfile.TemporaryDirectory() as place:
        path = Path(place) / "bridge-sharp.vtu"
        write(path, make("bridge-sharp", size=9000, scramble=0.3))
        window = open_window(path)
        compare(window)
        show(window, *_SHOWN)
        screenshot(window, folder / "compare-views.png")
        figure = folder / "compare-figure.png"
        wait_until_drawn(window)
        window.features["export"].picture(figure, (1000, 640))
        compress(figure)
        window.messages.clear()
        choose(ThemeChoice.DARK)
        window.session.side_views.set_wiping(True)
        window.session.side_views.move_wipe(0.45)
        screenshot(window, folder / "compare-wipe.png")
        close_window(window)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
