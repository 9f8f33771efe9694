"""Take the picture of docs/repair/untangle.md: a hex that is invalid inside, and where.

Use: HEXMEND_MESHES=folder python scripts/pictures/invalid_inside.py FOLDER
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

from screenshots import compress

#: The worse of the two hexes of the mesh that are invalid inside.
_HEX = 29


def main(folder: Path) -> None:
    """Draw the hex alone."""
    mesh, picture = Path(os.environ["HEXMEND_MESHES"]) / "Dolphin_2.mesh", folder / "invalid-inside.png"
    words = ["render", mesh, "-o", picture, "--view=1,-0.6,0.5", "--size", "880x480"]
    isolate = f"show.isolate={{ hexes = [{_HEX}], rings = 0 }}"
    words += ["--key", isolate, "--key", f"show.marked=[{_HEX}]", "--key", "show.outline=false"]
    subprocess.run([sys.executable, "-m", "hexmend", *map(str, words)], check=True)
    compress(picture)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
