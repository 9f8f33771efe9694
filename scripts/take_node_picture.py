"""Takes the picture of docs/node-step.md: a node of a tangled mesh, its step by local steepest descent.

Use: xvfb-run -s "-screen 0 1600x1000x24" python scripts/take_node_picture.py FOLDER
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

from take_screenshots import opened, shoot, shut, turn, until

from hexmend.gallery import make
from hexmend.io import write


def main(folder: Path) -> None:
    """Take it."""
    with tempfile.TemporaryDirectory() as place:
        path = Path(place) / "bridge-sharp.vtu"
        write(path, make("bridge-sharp", size=4000, scramble=0.3, seed=1))
        window = opened(path, (1240, 780))
        panel, chosen = window.features["node"].panel, window.session.document.now.mesh
        window.features["smooth"].panel.set_method("local-sd")
        window.show_panel("node")
        node = int(chosen.free.nonzero()[0][2000])
        window.session.selection.choose(int(chosen.topology.node_corners[node][0] // 8), node)
        until(lambda: window.canvas.viewport.node_step is not None)
        panel._patch.click()
        turn(1)
        camera = window.canvas.viewport.camera
        camera.Azimuth(-40)
        camera.Zoom(1.5)
        window.canvas.rest()
        shoot(window, folder / "node-step.png")
        shut(window)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
