"""Take the pictures of tutorial.md: the demo opened, its inverted hexes isolated, mended, compared, as a figure.

Use: xvfb-run -s "-screen 0 1600x1000x24" python scripts/pictures/tutorial.py FOLDER
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
    run_method,
    screenshot,
    set_method,
    wait_until,
    zoom_out,
)

from hexmend.cli.main import main as hexmend
from hexmend_app.resources import demo_mesh
from hexmend_app.shell.window import Window

_SIZE = (1280, 760)


def show_inverted(window: Window) -> None:
    """Isolate the inverted hexes, as a click on their bar does."""
    window.features["histogram"].panel.inverted_requested.emit()
    window.refresh()


def compare(window: Window) -> None:
    """Run the methods that are ticked by default, and overlay Laplacian smoothing and mend."""
    set_method(window, "mend")
    window.action("compare").trigger()
    wait_until(lambda: window.session.comparison.results and not window.session.comparison.busy)
    for name in ("laplacian", "mend"):
        window.features["compare"].panel.model.view_toggled.emit(name, True)
        window.refresh()


def figure(path: Path) -> None:
    """Draw the demo before and after, as the tutorial's last command does."""
    with tempfile.TemporaryDirectory() as place:
        mended = f"{place}/mended.vtu"
        hexmend(["smooth", str(demo_mesh()), "-o", mended])
        what = ["render", str(demo_mesh()), mended, "-o", str(path), "--captions", "before,after"]
        hexmend([*what, "--clip", "x", "--mm", "170x80", "--dpi", "150"])
    compress(path)


def main(folder: Path) -> None:
    """Take all pictures of the tutorial."""
    window = open_window(demo_mesh(), _SIZE)
    zoom_out(window)
    screenshot(window, folder / "tutorial-opened.png")
    show_inverted(window)
    screenshot(window, folder / "tutorial-inverted.png")
    window.action("back").trigger()
    window.session.view.set_handles(False)
    cut_mesh(window)
    run_method(window, "mend")
    window.show_panel("outcome")
    screenshot(window, folder / "tutorial-mended.png")
    window.action("undo").trigger()
    window.refresh()
    compare(window)
    screenshot(window, folder / "tutorial-compared.png")
    close_window(window)
    figure(folder / "tutorial-figure.png")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
