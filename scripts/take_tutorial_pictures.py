"""Takes the pictures of docs/tutorial.md: the demo opened, its inverted hexes alone, mended, compared, as a figure.

Use: xvfb-run -s "-screen 0 1600x1000x24" python scripts/take_tutorial_pictures.py FOLDER
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

from photographs import compress, cut, opened, run, set_method, shoot, shut, step_back, until

from hexmend.cli.main import main as hexmend
from hexmend_app.resources import demo_mesh
from hexmend_app.shell.window import Window

_SIZE = (1280, 760)


def show_inverted(window: Window) -> None:
    """Isolate them, as a click on their bar does."""
    window.features["histogram"].panel.inverted_requested.emit()
    window.refresh()


def compare(window: Window) -> None:
    """Run the methods that are ticked at first, and lay Laplacian smoothing and mend over one another."""
    set_method(window, "mend")
    window.action("compare").trigger()
    until(lambda: window.session.comparison.results and not window.session.comparison.busy)
    for name in ("laplacian", "mend"):
        window.features["compare"].panel.view_toggled.emit(name, True)
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
    """Go through the tutorial."""
    window = opened(demo_mesh(), _SIZE)
    step_back(window)
    shoot(window, folder / "tutorial-opened.png")
    show_inverted(window)
    shoot(window, folder / "tutorial-inverted.png")
    window.action("back").trigger()
    window.session.view.set_handles(False)
    cut(window)
    run(window, "mend")
    window.show_panel("outcome")
    shoot(window, folder / "tutorial-mended.png")
    window.action("undo").trigger()
    window.refresh()
    compare(window)
    shoot(window, folder / "tutorial-compared.png")
    shut(window)
    figure(folder / "tutorial-figure.png")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
