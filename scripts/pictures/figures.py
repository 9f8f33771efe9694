"""Take the pictures of docs/results/figures.md: its examples, drawn of foreign meshes, and the dialogs.

Use: HEXMEND_MESHES=folder xvfb-run -s "-screen 0 1600x1000x24" python scripts/pictures/figures.py FOLDER
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from PySide6.QtWidgets import QDialog
from screenshots import close_window, compress, cut_mesh, open_window, process_events, wait_until, wait_until_drawn

from hexmend_app.shell.window import Window
from hexmend_app.state.run.run_controller import Phase

PAGE = Path(__file__).resolve().parents[2] / "docs" / "results" / "figures.md"

#: Pixels per inch, enough for a screen.
_DPI = "150"


def hexmend(*words: object) -> None:
    """Run a command; its output goes to the terminal."""
    subprocess.run([sys.executable, "-m", "hexmend", *map(str, words)], check=False)


def main(folder: Path) -> None:
    """Take all pictures of the page."""
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
    window = open_window(bunny, (1366, 768))
    cut_mesh(window)
    wait_until_drawn(window)
    dialog = window.features["export"].dialog("picture")
    dialog.settings.size_form.size_box.setCurrentIndex(2)
    dialog.target.line.setText("bunny.png")
    photograph(dialog, folder / "figures-dialog.png")
    run(window)
    chart = window.features["histogram"].dialog()
    chart.names["at the start"].setText("as given")
    chart.names["now"].setText("mended")
    chart.target.line.setText("bunny-histogram.svg")
    photograph(chart, folder / "figures-chart.png")
    close_window(window)


def photograph(dialog: QDialog, path: Path) -> None:
    """Take a screenshot of a dialog once its preview is drawn."""
    dialog.show()
    process_events(2)
    dialog.grab().save(str(path))
    compress(path)
    dialog.close()


def run(window: Window) -> None:
    """Run the default method to its end."""
    window.action("run").trigger()
    wait_until(lambda: window.session.run.phase is Phase.FINISHED)
    wait_until_drawn(window)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
