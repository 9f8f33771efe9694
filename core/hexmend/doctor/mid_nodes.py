"""Problem of second-order hexes: mid-nodes that bend edges so far that the hex is invalid between sound corners."""

from __future__ import annotations

import numpy as np

from hexmend.arrays import mask
from hexmend.doctor.problem import NONE_FOUND, Finding, Problem, register_problem
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.second_order import MID_NODE_WEIGHTS
from hexmend.mesh.second_order.curved_geometry import FACE_COLUMNS
from hexmend.mesh.second_order.valid_mid_nodes import are_low, valid_mid_nodes
from hexmend.quality import corner_determinants
from hexmend.quality.validity import Validity, certify
from hexmend.terminal_text import count_phrase

#: Rings of hexes around invalid ones whose mid-nodes move too, where moving their own is not enough: thin layers at a
#: curved boundary bend with it.
_RINGS = 3


@register_problem
class BentEdges(Problem):
    """Second-order hexes whose corners are sound, and whose Jacobian is not positive everywhere."""

    name, title = "mid-nodes", "Mid-nodes"
    rank = 10
    remedy = "Mid-nodes inside the mesh can be moved until they are valid; those on the boundary keep its shape."
    action = "move the mid-nodes inside the mesh until the hexes are valid"

    def locate(self, mesh: Mesh, quick: bool = False) -> np.ndarray:
        if quick or mesh.mid_nodes is None:
            return NONE_FOUND
        return np.flatnonzero(_bad_between_corners(mesh, mesh.points))

    def describe(self, mesh: Mesh, where: np.ndarray) -> Finding:
        hexes = count_phrase(where.size, "hex of second order has", "hexes of second order have")
        text = f"{hexes} sound corners, but a Jacobian that is not positive everywhere."
        return self.finding(where, text, mendable=self.mend(mesh) is not mesh)

    def mend(self, mesh: Mesh) -> Mesh:
        assert mesh.mid_nodes is not None
        points, kept = mesh.points.copy(), _kept_mid_nodes(mesh)
        given = bad = low = _bad_between_corners(mesh, points)
        for rings in (None, *range(_RINGS + 1)):  # first halfway alone, which is quick and leaves small patches
            if not low.any():
                break
            near, start = low.copy(), points.copy()
            was_invalid = _invalid(points, mesh, np.arange(mesh.n_hexes))
            for hexes, nodes, positions in valid_mid_nodes(points, mesh.hexes, mesh.mid_nodes, low, kept, rings):
                near[hexes] = True
                points[nodes] = positions
                while (worse := _invalid(points, mesh, hexes) & ~was_invalid[hexes]).any():
                    back = mesh.mid_nodes[hexes[worse]]
                    points[back[back >= 0]] = start[back[back >= 0]]
            bad, some = _bad_between_corners(mesh, points), np.flatnonzero(near)
            low = mask(some[are_low(points, mesh.hexes[some], mesh.mid_nodes[some])], mesh.n_hexes)
        return mesh.rebuilt(points=points) if bad.sum() < given.sum() else mesh


def _bad_between_corners(mesh: Mesh, points: np.ndarray) -> np.ndarray:
    """Mark second-order hexes that are invalid between corners that are not inverted, (m,) bool."""
    assert mesh.mid_nodes is not None
    sound = (corner_determinants(points, mesh.hexes) > 0).all(axis=1) & (mesh.mid_nodes >= 0).any(axis=1)
    return sound & _invalid(points, mesh, np.arange(mesh.n_hexes))


def _invalid(points: np.ndarray, mesh: Mesh, hexes: np.ndarray) -> np.ndarray:
    """Mark the hexes among some (k,) that are not valid everywhere, (k,) bool."""
    assert mesh.mid_nodes is not None
    return certify(points, mesh.hexes[hexes], mesh.mid_nodes[hexes]) != Validity.VALID


def _kept_mid_nodes(mesh: Mesh) -> np.ndarray:
    """Mark nodes that stay: on the boundary, on interfaces, pinned or between such, of other cells, (n,) bool."""
    assert mesh.mid_nodes is not None
    across = mesh.topology.face_neighbours[: mesh.n_hexes]
    outer = across < 0
    if mesh.materials is not None:
        material = mesh.materials.of_hex
        outer = outer | (material[across] != material[: mesh.n_hexes, None])
    rows, faces = np.nonzero(outer)
    nodes = mesh.mid_nodes[rows[:, None], FACE_COLUMNS[faces]]
    kept = np.zeros(mesh.n_nodes, bool) if mesh.pinned is None else mesh.pinned.copy()
    kept[nodes[nodes >= 0]] = True
    for cells in mesh.cells:
        kept[cells.nodes] = True
    if mesh.pinned is not None:  # mid-nodes all of whose corners are pinned
        for column, weights in enumerate(MID_NODE_WEIGHTS):
            nodes = mesh.mid_nodes[mesh.pinned[mesh.hexes[:, weights > 0]].all(axis=1), column]
            kept[nodes[nodes >= 0]] = True
    return kept
