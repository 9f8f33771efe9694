"""Problem of second-order hexes: mid-nodes that bend edges so far that the hex is invalid between sound corners."""

from __future__ import annotations

import numpy as np

from hexmend.doctor.problem import NONE_FOUND, Finding, Problem, register_problem
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.second_order import MID_NODE_WEIGHTS
from hexmend.mesh.second_order.curved_geometry import FACE_COLUMNS
from hexmend.quality import corner_determinants
from hexmend.quality.validity import Validity, certify
from hexmend.terminal_text import count_phrase


@register_problem
class BentEdges(Problem):
    """Second-order hexes whose corners are sound, and whose Jacobian is not positive everywhere."""

    name, title = "mid-nodes", "Mid-nodes"
    rank = 10
    remedy = "Mid-nodes inside the mesh can be put halfway between the corners; those on the boundary keep its shape."
    action = "put the mid-nodes inside the mesh halfway between the corners"

    def locate(self, mesh: Mesh, quick: bool = False) -> np.ndarray:
        if quick or mesh.mid_nodes is None:
            return NONE_FOUND
        return np.flatnonzero(_bad_between_corners(mesh, mesh.points))

    def describe(self, mesh: Mesh, where: np.ndarray) -> Finding:
        hexes = count_phrase(where.size, "hex of second order has", "hexes of second order have")
        text = f"{hexes} sound corners, but a Jacobian that is not positive everywhere."
        return self.finding(where, text, mendable=self.mend(mesh) is not mesh)

    def mend(self, mesh: Mesh) -> Mesh:
        where = self.locate(mesh)
        assert mesh.mid_nodes is not None
        movable = ~_kept_mid_nodes(mesh)
        rows = mesh.mid_nodes[where]
        hexes, columns = np.nonzero((rows >= 0) & movable[rows])
        points = mesh.points.copy()
        corners = mesh.points[mesh.hexes[where[hexes]]]
        points[rows[hexes, columns]] = np.einsum("kc,kcx->kx", MID_NODE_WEIGHTS[columns], corners)
        fewer = np.count_nonzero(_bad_between_corners(mesh, points)) < where.size
        return mesh.rebuilt(points=points) if fewer else mesh


def _bad_between_corners(mesh: Mesh, points: np.ndarray) -> np.ndarray:
    """Mark second-order hexes that are invalid between corners that are not inverted, (m,) bool."""
    assert mesh.mid_nodes is not None
    sound = (corner_determinants(points, mesh.hexes) > 0).all(axis=1) & (mesh.mid_nodes >= 0).any(axis=1)
    return sound & (certify(points, mesh.hexes, mesh.mid_nodes) != Validity.VALID)


def _kept_mid_nodes(mesh: Mesh) -> np.ndarray:
    """Mark the nodes that stay: on the boundary, on interfaces, pinned, or shared with other cells, (n,) bool."""
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
    return kept
