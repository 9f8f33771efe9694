"""Problems of hexes: duplicates, and hexes with repeated nodes."""

from __future__ import annotations

import numpy as np

from hexmend.doctor.problem import Finding, Problem, register_problem
from hexmend.mesh.collapsed_hexes import are_flat, has_repeated_node, keep_hexes, with_collapsed_converted
from hexmend.mesh.mesh import Mesh
from hexmend.terminal_text import count_phrase


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
    remedy = "Convert them to wedges, pyramids and tetrahedra, or remesh them."
    action = "make wedges, pyramids and tetrahedra of those that are, and remove flat ones, with the sides on them"

    def locate(self, mesh: Mesh, quick: bool = False) -> np.ndarray:
        return np.flatnonzero(has_repeated_node(mesh.hexes))

    def describe(self, mesh: Mesh, where: np.ndarray) -> Finding:
        flat = np.count_nonzero(are_flat(mesh.points, mesh.hexes[where]))
        return self.finding(
            where,
            f"{count_phrase(where.size, 'hex uses', 'hexes use')} a node twice, so that edges are collapsed"
            f"{f'; {flat:,} of them are flat' if flat else ''}: as hexes they can never be good.",
            mendable=self.mend(mesh) is not mesh,
        )

    def mend(self, mesh: Mesh) -> Mesh:
        converted = with_collapsed_converted(mesh)[0]
        where = self.locate(converted)
        flat = where[are_flat(converted.points, converted.hexes[where])]
        if not 0 < flat.size < converted.n_elements:
            return converted
        return keep_hexes(converted, ~np.isin(np.arange(converted.n_hexes), flat))


def _repeated(rows: np.ndarray) -> np.ndarray:
    """True for rows (n, k) that are equal to an earlier row, (n,) bool."""
    order = np.lexsort(rows.T)
    same = (rows[order][1:] == rows[order][:-1]).all(axis=1)
    again = np.zeros(len(rows), dtype=bool)
    again[order[1:][same]] = True  # lexsort is stable: the first of equal rows comes first
    return again
