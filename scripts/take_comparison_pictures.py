"""Takes the pictures of docs/compare.md, of meshes that the gallery makes.

Use: xvfb-run -s "-screen 0 1600x1000x24" python scripts/take_comparison_pictures.py FOLDER
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

from photographs import compress, cut, opened, set_method, settle, shoot, shut, until

from hexmend.gallery import make
from hexmend.io import write
from hexmend_app.shell.window import Window
from hexmend_app.widgets.theming import Choice, choose

_SHOWN = ("laplacian", "getme", "mend")


def compare(window: Window) -> None:
    """Run the methods that are ticked at first, and cut the mesh open."""
    window.show_panel("compare")
    set_method(window, "mend", max_iterations=100)
    window.action("compare").trigger()
    until(lambda: window.session.comparison.results and not window.session.comparison.busy)
    window.session.view.set_handles(False)
    cut(window)


def show(window: Window, *names: str) -> None:
    """Put results into views."""
    for name in names:
        window.features["compare"].panel.view_toggled.emit(name, True)
        window.refresh()


def main(folder: Path) -> None:
    """Take them all."""
    with tempfile.TemporaryDirectory() as place:
        path = Path(place) / "bridge-sharp.vtu"
        write(path, make("bridge-sharp", size=9000, scramble=0.3))
        window = opened(path)
        compare(window)
        show(window, *_SHOWN)
        shoot(window, folder / "compare-views.png")
        figure = folder / "compare-figure.png"
        settle(window)
        window.features["save"].picture(figure, (1000, 640))
        compress(figure)
        window.messages.clear()
        choose(Choice.DARK)
        window.session.views.set_wiping(True)
        window.session.views.move_wipe(0.45)
        shoot(window, folder / "compare-wipe.png")
        shut(window)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
