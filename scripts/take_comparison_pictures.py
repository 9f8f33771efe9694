"""Takes the pictures of docs/compare.md, of meshes that the gallery makes.

Use: xvfb-run -s "-screen 0 1600x1000x24" python scripts/take_comparison_pictures.py FOLDER
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

from PIL import Image
from take_screenshots import opened, shoot, shut, turn, until

from hexmend.gallery import make
from hexmend.io import write
from hexmend_app.scene.palette import Choice
from hexmend_app.shell.window import Window
from hexmend_app.state.clip import PlaneClip
from hexmend_app.widgets.theming import choose

_SHOWN = ("laplacian", "getme", "mend")


def compare(window: Window) -> None:
    """Run the methods that are ticked at first, and cut the mesh open."""
    window.show_panel("compare")
    window.features["smooth"].panel.stop_form.set_values({"max_iterations": 100})
    window.features["compare"].panel.run()
    until(lambda: not window.session.comparison.busy)
    window.session.view.set_handles(False)
    window.session.view.set_clip(PlaneClip.at((1, 0, 0), tuple(window.session.document.now.mesh.points.mean(axis=0))))


def show(window: Window, *names: str) -> None:
    """Put results into views."""
    for name in names:
        window.features["compare"].panel.view_toggled.emit(name, True)
    turn(0.5)


def main(folder: Path) -> None:
    """Take them all."""
    with tempfile.TemporaryDirectory() as place:
        path = Path(place) / "bridge-sharp.vtu"
        write(path, make("bridge-sharp", size=9000, scramble=0.3))
        window = opened(path, (1240, 780))
        compare(window)
        show(window, *_SHOWN)
        shoot(window, folder / "compare-views.png")
        figure = folder / "compare-figure.png"
        window.features["save"].picture(figure, (1000, 640))
        Image.open(figure).convert("RGB").save(figure, optimize=True)
        window.messages.clear()
        choose(Choice.DARK)
        window.session.views.set_wiping(True)
        window.session.views.move_wipe(0.45)
        shoot(window, folder / "compare-wipe.png")
        shut(window)
    choose(Choice.LIGHT)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
