"""Take the picture of docs/repair/doctor.md: the doctor on blocks that are not merged.

Use: xvfb-run -s "-screen 0 1600x1000x24" python scripts/pictures/doctor.py FOLDER [MESH ...]

With meshes named, the script takes a screenshot of each with the doctor's panel, doctor-0.png and so on.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

import numpy as np
from screenshots import open_window, screenshot, wait_until, wait_until_drawn

from hexmend.gallery import make
from hexmend.io import write
from hexmend.mesh.mesh import Mesh


def blocks() -> Mesh:
    """Two adjacent blocks that are not merged, one of them inside out, with a duplicate hex."""
    one = make("cube", size=512, scramble=0.3)
    other = np.column_stack([2 * one.points[:, 0].max() - one.points[:, 0], one.points[:, 1:]])  # mirrored
    return Mesh(np.vstack([one.points, other]), np.vstack([one.hexes, one.hexes + one.n_nodes, one.hexes[:1]]))


def main() -> None:
    folder, meshes = Path(sys.argv[1]), sys.argv[2:]
    with tempfile.TemporaryDirectory() as there:
        if not meshes:
            meshes = [f"{there}/blocks.vtu"]
            write(meshes[0], blocks())
        for k, mesh in enumerate(meshes):
            window = open_window(mesh, (1366, 768))
            window.show_panel("doctor")
            window.refresh()
            wait_until(lambda session=window.session: session.mesh_checker.of(session.document.now.mesh) is not None)
            wait_until_drawn(window)
            screenshot(window, folder / (f"doctor-{k}.png" if k else "doctor.png"))
            window.close()


if __name__ == "__main__":
    main()
