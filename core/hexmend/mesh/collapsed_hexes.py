"""Hexes with repeated nodes that are wedges, pyramids or tetrahedra, and meshes with some of their hexes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import combinations

import numpy as np

from hexmend.arrays import index_of
from hexmend.kernels import faces
from hexmend.mesh.cells import Cells
from hexmend.mesh.hexahedron import FACES
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.solid_cells import SOLID_BLOCKS, TETRAHEDRON, padded
from hexmend.terminal_text import count_phrase

#: Kind of cell by the sizes of the faces that remain of a collapsed hex.
_KINDS = {(3, 3, 3, 3): "tetra", (3, 3, 3, 3, 4): "pyramid", (3, 3, 4, 4, 4): "wedge"}
#: Words for them.
_WORDS = {
    "tetra": ("tetrahedron", "tetrahedra"),
    "pyramid": ("pyramid", "pyramids"),
    "wedge": ("wedge", "wedges"),
}
#: Volume, as a share of the cube of a cell's extent, below which a cell is flat.
FLAT = 1e-9


def with_collapsed_converted(mesh: Mesh) -> tuple[Mesh, str]:
    """Make wedges, pyramids and tetrahedra of the hexes that their repeated nodes make such.

    Hexes of second order, flat ones, and those of other forms stay. Sides on the converted ones are left out.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    Mesh
        The same one if nothing is converted.
    str
        Sentence about the change; "" for none.
    """
    cells, gone = [], np.zeros(mesh.n_hexes, dtype=bool)
    for kind, rows, nodes in collapsed_solids(mesh.hexes):
        kept = ~are_flat(mesh.points, padded(SOLID_BLOCKS[kind], nodes))
        if mesh.mid_nodes is not None:
            kept &= (mesh.mid_nodes[rows] < 0).all(axis=1)
        rows, nodes = rows[kept], nodes[kept]
        gone[rows] = True
        data = {name: values[rows] for name, values in mesh.hex_data.items()}
        sets = renumbered_sets(mesh.hex_sets, index_of(rows, mesh.n_hexes))
        if rows.size:
            cells.append(Cells(kind, nodes, data, sets))
    if not cells:
        return mesh, ""
    counts = {kind: sum(len(block.nodes) for block in cells if block.kind == kind) for kind in _WORDS}
    listed = ", ".join(count_phrase(count, *_WORDS[kind]) for kind, count in counts.items() if count)
    text = f"{count_phrase(int(gone.sum()), 'hex is', 'hexes are')} collapsed, and read as {listed}."
    return keep_hexes(mesh.replace(cells=(*mesh.cells, *cells)), ~gone), text


def collapsed_solids(hexes: np.ndarray) -> Iterator[tuple[str, np.ndarray, np.ndarray]]:
    """Find the hexes whose repeated nodes make wedges, pyramids or tetrahedra of them.

    Parameters
    ----------
    hexes : (m, 8) int

    Yields
    ------
    kind : str
        Kind of the cells of a form.
    rows : (k,) int64
        Hexes of this form.
    nodes : (k, 4 to 6) int
        Their nodes in VTK's order.
    """
    some = np.flatnonzero(has_repeated_node(hexes))
    first = (hexes[some, :, None] == hexes[some, None, :]).argmax(axis=2)
    patterns, which = np.unique(first, axis=0, return_inverse=True)
    for i, pattern in enumerate(patterns.tolist()):
        if (found := _solid(pattern)) is not None:
            rows = some[which.reshape(-1) == i]
            yield found[0], rows, hexes[rows][:, found[1]]


def has_repeated_node(hexes: np.ndarray) -> np.ndarray:
    """Return True for hexes (m, 8) that use a node twice, (m,) bool."""
    found = np.zeros(len(hexes), dtype=bool)
    for a, b in combinations(range(8), 2):
        found |= hexes[:, a] == hexes[:, b]
    return found


def _solid(pattern: list[int]) -> tuple[str, list[int]] | None:
    """Kind of cell that a hex is whose corners are those of a pattern (8,), and its nodes; None if it is none."""
    if pattern == [0, 1, 2, 3, 3, 3, 3, 3]:  # LS-DYNA's way, by which the base would be a quad
        return "tetra", [*range(TETRAHEDRON.nodes)]
    loops = []
    for face in FACES.tolist():
        loop = [pattern[a] for a, b in zip(face, face[1:] + face[:1], strict=True) if pattern[a] != pattern[b]]
        if len(set(loop)) < len(loop):
            return None
        if len(loop) > 2:
            loops.append(loop)
    kind = _KINDS.get(tuple(sorted(map(len, loops))))
    if kind is None or len(set(pattern)) != SOLID_BLOCKS[kind].nodes:
        return None
    first, *rest = next(loop for loop in loops if len(loop) == (4 if kind == "pyramid" else 3))
    base = [first, *reversed(rest)]  # seen from inside
    others = sorted(set(pattern) - set(base))
    if kind != "wedge":
        return kind, base + others
    edges = {frozenset(edge) for loop in loops for edge in zip(loop, loop[1:] + loop[:1], strict=True)}
    return kind, base + [other for node in base for other in others if frozenset((node, other)) in edges]


def are_flat(points: np.ndarray, rows: np.ndarray) -> np.ndarray:
    """Mark cells (k, 8) int32 without volume, (k,) bool."""
    volumes, corners = np.empty(len(rows)), points[rows]
    faces.volume(points, np.ascontiguousarray(rows), volumes)
    return ~(np.abs(volumes) > FLAT * np.ptp(corners, axis=1).max(axis=1) ** 3)


def keep_hexes(mesh: Mesh, kept: np.ndarray, representative: np.ndarray | None = None) -> Mesh:
    """Return the mesh with some of its hexes; all nodes stay.

    Parameters
    ----------
    mesh : Mesh
    kept : (m,) bool
        True for hexes to be kept.
    representative : (m,) int, optional
        Hex that replaces each hex in sets, such as the kept one of duplicates.

    Returns
    -------
    Mesh
    """
    rows = np.flatnonzero(kept)
    place = index_of(rows, mesh.n_hexes)
    if representative is not None:
        place = place[representative]
    sides = {name: np.column_stack([place[side[:, 0]], side[:, 1]]) for name, side in mesh.side_sets.items()}
    return mesh.rebuilt(
        hexes=mesh.hexes[rows],
        hex_data={name: values[rows] for name, values in mesh.hex_data.items()},
        hex_sets=renumbered_sets(mesh.hex_sets, place),
        side_sets={name: faces[faces[:, 0] >= 0] for name, faces in sides.items() if (faces[:, 0] >= 0).any()},
        mid_nodes=None if mesh.mid_nodes is None else mesh.mid_nodes[rows],
    )


def renumbered_sets(sets: Mapping[str, np.ndarray], place: np.ndarray) -> dict[str, np.ndarray]:
    """Return sets in new numbers, place[old], without members of negative ones and without empty sets."""
    answer = {}
    for name, members in sets.items():
        there = place[members]
        there = np.unique(there[there >= 0])
        if len(there):
            answer[name] = there
    return answer
