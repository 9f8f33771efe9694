"""Print the table of docs/padding.md: meshes before and after padding, with the boundary as it was.

Use: HEXMEND_MESHES=folder python scripts/padding_table.py
"""

from __future__ import annotations

import os
import time
from pathlib import Path

import numpy as np

import hexmend as hx

#: Mesh, and the argument `around`.
_CASES = (
    ("bunny.vtk", None),
    ("bunny.vtk", "locked"),
    ("bunnyPer.vtk", None),
    ("block_in.mesh", None),
    ("cap_in.mesh", None),
    ("dragon_in.mesh", None),
    ("dragon_in.mesh", "locked"),
    ("jet.exo", None),
    ("n10-id2_hex.msh", None),
)


def moved(given: hx.Mesh, padded: hx.Mesh) -> float:
    """Largest displacement of a boundary node."""
    boundary = given.topology.boundary
    return float(np.abs(padded.points[: given.n_nodes] - given.points)[boundary].max())


def main() -> None:
    """Pad and mend each mesh, and print a line for it."""
    folder = Path(os.environ["HEXMEND_MESHES"])
    print("| mesh | layer | hexes | inverted (locked) | scaled Jacobian min | q mean | boundary moved | s |")
    print("|:---|:---|---:|---:|---:|---:|---:|---:|")
    for file, around in _CASES:
        mesh = hx.read(folder / file)
        began = time.perf_counter()
        padding = hx.pad(mesh, around=around)
        seconds = time.perf_counter() - began
        before, after = padding.before, padding.after
        print(
            f"| {file} | {f'around {around}' if around else 'whole boundary'} | {before.hexes:,} → {after.hexes:,} "
            f"| {before.inverted} ({before.locked_inverted}) → {after.inverted} "
            f"| {before.scaled_jacobian_min:.4f} → {after.scaled_jacobian_min:.4f} "
            f"| {before.q_mean:.4f} → {after.q_mean:.4f} | {moved(mesh, padding.mesh):g} | {seconds:.1f} |",
            flush=True,
        )


if __name__ == "__main__":
    main()
