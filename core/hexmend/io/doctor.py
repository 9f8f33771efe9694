"""Trouble in a mesh that can be read all the same."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.io.orientation import turned
from hexmend.mesh import Mesh
from hexmend.quality import measure


@dataclass(frozen=True)
class Finding:
    """Something to know of a mesh: its kind, how many, a sentence, and what to do."""

    kind: str
    count: int
    message: str
    remedy: str = ""


def examine(mesh: Mesh) -> tuple[Finding, ...]:
    """Look for trouble: time linear in the size of the mesh, but for two sorts."""
    found = []

    def add(kind: str, count: int, message: str, remedy: str = "") -> None:
        if count:
            found.append(Finding(kind, count, message.format(count=f"{count:,}"), remedy))

    used = mesh.topology.used.copy()
    for nodes in (() if mesh.mid_nodes is None else (mesh.mid_nodes[mesh.mid_nodes >= 0],)) + tuple(
        cells.nodes for cells in mesh.cells
    ):
        used[nodes] = True
    unused = int(np.count_nonzero(~used))
    add("unused-nodes", unused, "{count} nodes belong to no hex; they are kept and never moved.")
    places = mesh.points[mesh.topology.used]
    add(
        "coincident-nodes",
        _repeated(places + 0.0),  # -0 and 0 are one place
        "{count} nodes lie on others; hexes that should be joined may be apart there.",
        "Merge coincident nodes in the program that made the mesh if that is not meant.",
    )
    rows = np.sort(mesh.hexes, axis=1)
    degenerate = int(np.count_nonzero((rows[:, 1:] == rows[:, :-1]).any(axis=1)))
    add("degenerate-hexes", degenerate, "{count} hexes use a node twice: they can never be good.", "Mesh them anew.")
    add(
        "duplicate-hexes",
        _repeated(rows),
        "{count} hexes stand on the nodes of others.",
        "Remove the duplicates.",
    )
    add(
        "crowded-faces",
        mesh.topology.crowded_faces,
        "{count} faces (counted once a hex) belong to more than two hexes; they are treated as boundary.",
        "Look for overlapping hexes.",
    )
    add(
        "parts",
        mesh.topology.parts - 1,
        "the mesh has {count} parts besides the first that hang together with no other.",
    )
    if (measure(mesh.points, mesh.hexes).scaled_jacobian <= 0).all() and _all_mirrored(mesh):
        add(
            "mirrored",
            mesh.n_hexes,
            "all {count} hexes are inside out: their corners are numbered left-handed.",
            "Swap the lower and the upper face of every hex (hexmend.io.doctor.mirrored does).",
        )
    return tuple(found)


def mirrored(mesh: Mesh) -> Mesh:
    """The mesh with the lower and the upper face of every hex swapped, which turns each inside out."""
    return turned(mesh, np.ones(mesh.n_hexes, dtype=bool))


def _repeated(rows: np.ndarray) -> int:
    """How many rows (n, k) are the same as one before them.

    A number is made of each row, which equal rows share: where all numbers differ no row is repeated, and the rows
    themselves need not be sorted, which takes ten times longer.
    """
    bits = rows.view(f"u{rows.itemsize}").astype(np.uint64)
    bits ^= bits >> np.uint64(32)
    numbers = np.zeros(len(rows), np.uint64)
    for column in bits.T:
        numbers = (numbers ^ column) * np.uint64(0x9E3779B97F4A7C15)
        numbers ^= numbers >> np.uint64(29)
    numbers.sort()
    if (numbers[1:] != numbers[:-1]).all():
        return 0
    return len(rows) - len(np.unique(rows, axis=0))


def _all_mirrored(mesh: Mesh) -> bool:
    turned = mirrored(mesh)
    return bool(np.median(measure(turned.points, turned.hexes).sigma) > 0)
