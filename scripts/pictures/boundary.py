"""Take the pictures of docs/repair/boundary.md: foreign meshes before and after, with a sliding boundary.

Use: HEXMEND_MESHES=folder python scripts/pictures/boundary.py FOLDER
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from pathlib import Path

from screenshots import compress

#: Mesh files and the direction of view.
_MESHES = {"bunny.vtk": "+z", "impeller.vtk": "+x", "cap_in.mesh": "+x"}


def hexmend(*words: object) -> None:
    """Run a command; its output goes to the terminal."""
    subprocess.run([sys.executable, "-m", "hexmend", *map(str, words)], check=False)


def main(folder: Path) -> None:
    """Mend each mesh, and draw it next to the original."""
    meshes = Path(os.environ["HEXMEND_MESHES"])
    for file, view in _MESHES.items():
        name = file.partition(".")[0].removesuffix("_in")
        with tempfile.TemporaryDirectory() as scratch:
            mended = Path(scratch) / f"{name}.vtu"
            goal = "--method", "mend", "--set", "goal=scaled-jacobian", "--boundary", "slide"
            picture = folder / f"boundary-{name}.png"
            hexmend("smooth", meshes / file, "-o", mended, *goal)
            hexmend(
                "render", meshes / file, mended, "-o", picture, f"--view={view}",
                "--size", "880x440", "--captions", f"{name} as given,mended", "--metric", "scaled-jacobian",
            )  # fmt: skip
            compress(picture)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
