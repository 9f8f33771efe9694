"""Write meshes in every format and read them again: hexes and positions are the same, or the loss is reported.

Use: python scripts/round_trips.py FOLDER

A row a file of the folder, a column a format; "=" where all that came with the mesh is held, a number where so many
kinds of things are left out, which is said before writing. Exit status 1 where a hex is another.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

import numpy as np

from hexmend import io
from hexmend.errors import FileError
from hexmend.io.base.format import FORMATS
from hexmend.mesh.mesh import Mesh

#: Tolerance of formats with few decimals, relative to the largest coordinate.
NEAR = 1e-6


def same(one: Mesh, other: Mesh) -> bool:
    """Return True if the hexes have the same corners at the same positions in the same order."""
    if one.n_hexes != other.n_hexes:
        return False
    a, b = one.points[one.hexes], other.points[other.hexes]
    return bool(np.allclose(a, b, rtol=0, atol=NEAR * np.abs(a).max()))


def cell(mesh: Mesh, path: Path) -> str:
    """Write and read a mesh, and describe the result."""
    left = io.unsupported_data(path, mesh)
    try:
        io.write(path, mesh)
    except FileError:
        return "refused"
    return (str(len(left)) if left else "=") if same(mesh, io.read(path, as_is=True)) else "DIFFERS"


def main() -> int:
    formats = [format for format in FORMATS.values() if format.write]
    print(f"| mesh | hexes | {' | '.join(format.name for format in formats)} |")
    print(f"|:---|---:|{'---:|' * len(formats)}")
    cells = []
    with tempfile.TemporaryDirectory() as folder:
        for path in sorted(Path(sys.argv[1]).iterdir()):
            try:
                mesh = io.read(path)
            except FileError:  # no mesh
                continue
            row = [cell(mesh, Path(folder) / f"mesh{format.suffixes[0]}") for format in formats]
            cells += row
            print(f"| {path.name} | {mesh.n_hexes:,} | {' | '.join(row)} |", flush=True)
    bad = cells.count("DIFFERS")
    refused, whole = cells.count("refused"), cells.count("=")
    print(f"\n{len(cells)} round trips: {bad} differ, {refused} are refused, {whole} lose nothing.")
    return int(bad > 0)


if __name__ == "__main__":
    sys.exit(main())
