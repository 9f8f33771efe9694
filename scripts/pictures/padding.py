"""Take the picture of docs/repair/padding.md: a mesh with locked hexes, and padded, both cut open.

Use: HEXMEND_MESHES=folder python scripts/pictures/padding.py FOLDER
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from pathlib import Path

from screenshots import compress


def hexmend(*words: object) -> None:
    """Run a command; its output goes to the terminal."""
    subprocess.run([sys.executable, "-m", "hexmend", *map(str, words)], check=False)


def main(folder: Path) -> None:
    """Pad the mesh, and draw it next to the original."""
    given, picture = Path(os.environ["HEXMEND_MESHES"]) / "bunny.vtk", folder / "padding.png"
    with tempfile.TemporaryDirectory() as scratch:
        padded = Path(scratch) / "padded.vtu"
        hexmend("pad", given, "-o", padded)
        hexmend(
            "render", given, padded, "-o", picture, "--view=+y", "--clip", "y:0.5", "--size", "880x440",
            "--captions", "as given,padded", "--metric", "scaled-jacobian",
        )  # fmt: skip
    compress(picture)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
