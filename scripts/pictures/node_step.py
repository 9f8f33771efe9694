"""Take the picture of docs/methods/node-step.md: a node of a tangled mesh and its step by local steepest descent.

Use: xvfb-run -s "-screen 0 1600x1000x24" python scripts/pictures/node_step.py FOLDER
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

from screenshots import click, close_window, open_window, screenshot, set_method, wait_until, wait_until_drawn

from hexmend.gallery import make
from hexmend.io import write


def main(folder: Path) -> None:
    """Take the picture."""
    with tempfile.TemporaryDirectory() as place:
        path = Path(place) / "bridge-sharp.vtu"
        write(path, make("bridge-sharp", size=4000, scramble=0.3, seed=1))
        window = open_window(path)
        mesh = window.session.document.now.mesh
        set_method(window, "local-sd")
        window.show_panel("node")
        node = int(mesh.free.nonzero()[0][2010])
        window.session.selection.choose(int(mesh.topology.node_corners[node][0] // 8), node)
        wait_until(lambda: window.canvas.viewport.overlay_layers.selection.node_step is not None)
        click(window, "Isolate patch")
        wait_until_drawn(window)
        camera = window.canvas.viewport.camera
        camera.Azimuth(-40)
        camera.Zoom(1.5)
        window.canvas.draw_soon()
        screenshot(window, folder / "node-step.png")
        close_window(window)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
