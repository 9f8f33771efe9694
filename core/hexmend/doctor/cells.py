"""Problems of hexes: duplicates, and hexes with repeated nodes."""

from __future__ import annotations

import numpy as np

from hexmend.doctor.problem import Finding, Problem, register_problem
from hexmend.doctor.removal import has_repeated_node, keep_hexes
from hexmend.mesh.cells import Cells
from hexmend.mesh.hexahedron import EDGES
from hexmend.mesh.mesh import Mesh
from hexmend.terminal_text import count_phrase

#: Corners of a hex that form a wedge, in VTK's order, for each pair of opposite edges of a face that are collapsed.
_WEDGES = {
    frozenset({(0, 4), (3, 7)}): (0, 5, 1, 3, 6, 2),
    frozenset({(4, 7), (0, 3)}): (4, 6, 5, 0, 2, 1),
    frozenset({(1, 2), (5, 6)}): (1, 3, 0, 5, 7, 4),
    frozenset({(2, 6), (1, 5)}): (2, 7, 3, 1, 4, 0),
    frozenset({(0, 1), (4, 5)}): (0, 2, 3, 4, 6, 7),
    frozenset({(1, 5), (0, 4)}): (1, 6, 2, 0, 7, 3),
    frozenset({(3, 7), (2, 6)}): (3, 4, 0, 2, 5, 1),
    frozenset({(6, 7), (2, 3)}): (7, 5, 4, 3, 1, 0),
    frozenset({(0, 3), (1, 2)}): (0, 7, 4, 1, 6, 5),
    frozenset({(2, 3), (0, 1)}): (3, 6, 7, 0, 5, 4),
    frozenset({(4, 5), (6, 7)}): (4, 1, 0, 7, 2, 3),
    frozenset({(5, 6), (4, 7)}): (5, 2, 1, 4, 3, 0),
}


@register_problem
class DuplicateHexes(Problem):
    """Hexes with the same nodes as an earlier hex."""

    name, title = "duplicate-hexes", "Duplicate hexes"
    rank = 3
    remedy = "Remove the duplicates."
    action = "keep the first of each"

    def locate(self, mesh: Mesh, quick: bool = False) -> np.ndarray:
        return np.flatnonzero(_repeated(np.sort(mesh.hexes, axis=1)))

    def describe(self, mesh: Mesh, where: np.ndarray) -> Finding:
        phrase = count_phrase(where.size, "hex stands", "hexes stand")
        return self.finding(where, f"{phrase} on the nodes of others.")

    def mend(self, mesh: Mesh) -> Mesh:
        _, first, which = np.unique(np.sort(mesh.hexes, axis=1), axis=0, return_index=True, return_inverse=True)
        representative = first[which.reshape(-1)]
        return keep_hexes(mesh, representative == np.arange(mesh.n_hexes), representative)


@register_problem
class DegenerateHexes(Problem):
    """Hexes that use a node twice: their collapsed edges make good corners impossible."""

    name, title = "degenerate-hexes", "Collapsed hexes"
    rank = 5
    remedy = "Convert them to wedges, or remesh them."
    action = "keep wedges as wedges, whose nodes stay, and remove flat ones, with the sides on them"

    def locate(self, mesh: Mesh, quick: bool = False) -> np.ndarray:
        return np.flatnonzero(has_repeated_node(mesh.hexes))

    def describe(self, mesh: Mesh, where: np.ndarray) -> Finding:
        wedges, flat = _wedges(mesh, where)
        kinds = f"{len(wedges):,} of them are wedges, {len(flat):,} flat" if len(wedges) + len(flat) else ""
        return self.finding(
            where,
            f"{count_phrase(where.size, 'hex uses', 'hexes use')} a node twice, so that edges are collapsed"
            f"{'; ' + kinds if kinds else ''}: as hexes they can never be good.",
            mendable=0 < len(wedges) + len(flat) < mesh.n_hexes,
        )

    def mend(self, mesh: Mesh) -> Mesh:
        wedges, flat = _wedges(mesh, self.locate(mesh))
        gone = np.array([*wedges, *flat], dtype=np.int64)
        if not gone.size or gone.size == mesh.n_hexes:
            return mesh
        cells = mesh.cells
        pinned = np.zeros(mesh.n_nodes, dtype=bool) if mesh.pinned is None else mesh.pinned.copy()
        if wedges:
            nodes = np.array(list(wedges.values()), dtype=np.int32)
            pinned[nodes] = True
            which = np.array(list(wedges))
            data = {name: values[which] for name, values in mesh.hex_data.items()}
            sets = {name: np.flatnonzero(np.isin(which, members)) for name, members in mesh.hex_sets.items()}
            cells = (*cells, Cells("wedge", nodes, data, {name: rows for name, rows in sets.items() if rows.size}))
        return keep_hexes(mesh, ~np.isin(np.arange(mesh.n_hexes), gone)).replace(cells=cells, pinned=pinned)


def _wedges(mesh: Mesh, which: np.ndarray) -> tuple[dict[int, tuple[int, ...]], list[int]]:
    """Collapsed hexes that are wedges, with the wedges' nodes, and hexes of at most four nodes, which are flat."""
    wedges, flat = {}, []
    for h in which.tolist():
        nodes = mesh.hexes[h]
        if len(set(nodes.tolist())) <= 4:
            flat.append(h)
            continue
        collapsed = frozenset((min(a, b), max(a, b)) for a, b in EDGES.tolist() if nodes[a] == nodes[b])
        if len(set(nodes.tolist())) == 6 and collapsed in _WEDGES:
            wedges[h] = tuple(nodes[list(_WEDGES[collapsed])].tolist())
    return wedges, flat


def _repeated(rows: np.ndarray) -> np.ndarray:
    """True for rows (n, k) that are equal to an earlier row, (n,) bool."""
    order = np.lexsort(rows.T)
    same = (rows[order][1:] == rows[order][:-1]).all(axis=1)
    again = np.zeros(len(rows), dtype=bool)
    again[order[1:][same]] = True  # lexsort is stable: the first of equal rows comes first
    return again
