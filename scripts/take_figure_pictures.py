"""Takes the pictures of docs/figures.md: the page's own examples, of meshes of others, and the dialogs.

Use: HEXMEND_MESHES=folder xvfb-run -s "-screen 0 1600x1000x24" python scripts/take_figure_pictures.py FOLDER
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from photographs import compress, cut, opened, settle, shut, turn, until
from PySide6.QtWidgets import QDialog

from hexmend_app.shell.window import Window
from hexmend_app.state.run import Phase

PAGE = Path(__file__).resolve().parents[1] / "docs" / "figures.md"

#: Pixels per inch: enough for a screen.
_DPI = "150"


def hexmend(*words: object) -> None:
    """Run a command; its words go to the terminal."""
    subprocess.run([sys.executable, "-m", "hexmend", *map(str, words)], check=False)


def main(folder: Path) -> None:
    """Take them all."""
    bunny = Path(os.environ["HEXMEND_MESHES"]) / "bunny.vtk"
    two, three = re.findall(r"```toml\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
    with tempfile.TemporaryDirectory() as place:
        mended, scene = Path(place) / "mended.vtu", Path(place) / "scene.toml"
        hexmend("smooth", bunny, "-o", mended, "--boundary", "slide")
        for name, text, meshes in (("two", two, (bunny, mended)), ("three", three, (bunny,))):
            scene.write_text(text, encoding="utf-8")
            picture = folder / f"figures-{name}.png"
            hexmend("render", *meshes, "--scene", scene, "--dpi", _DPI, "-o", picture)
            compress(picture)
    window = opened(bunny, (1366, 768))
    cut(window)
    settle(window)
    dialog = window.features["save"].picture_dialog()
    dialog.size_form.preset.setCurrentIndex(2)
    dialog.size_form.preset.activated.emit(2)
    dialog.target.line.setText("bunny.png")
    photograph(dialog, folder / "figures-dialog.png")
    run(window)
    chart = window.features["histogram"].dialog()
    chart.names["at the start"].setText("as given")
    chart.names["now"].setText("mended")
    chart.target.line.setText("bunny-histogram.svg")
    photograph(chart, folder / "figures-chart.png")
    shut(window)


def photograph(dialog: QDialog, path: Path) -> None:
    """Photograph a dialog, once its preview is there."""
    dialog.show()
    turn(2)
    dialog.grab().save(str(path))
    compress(path)
    dialog.close()


def run(window: Window) -> None:
    """Run the default method to its end."""
    window.action("run").trigger()
    until(lambda: window.session.smoothing.phase is Phase.FINISHED)
    settle(window)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
