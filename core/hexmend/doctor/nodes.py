"""Problems of nodes: coincident, hanging and unused nodes."""

from __future__ import annotations

import numpy as np

from hexmend.doctor.problem import NONE_FOUND, Finding, Problem, register_problem
from hexmend.doctor.removal import referenced_nodes, renumber_nodes
from hexmend.kernels.closest_point import numbers_of_different_points
from hexmend.mesh.collapsed_hexes import has_repeated_node
from hexmend.mesh.materials import CONTACT_CARDS
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.topology.components import close_pairs, components
from hexmend.terminal_text import count_phrase

#: Largest distance of coincident nodes, in mean edge lengths.
MERGE_DISTANCE = 1e-6


@register_problem
class CoincidentNodes(Problem):
    """Nodes of one material at one position; where boundary faces coincide as well, blocks have not been merged."""

    name, title = "coincident-nodes", "Coincident nodes"
    items = "nodes"
    rank = 4
    remedy = "Merge them, unless parts are meant to slide on each other."
    action = "merge them, so that faces on each other become one"

    def locate(self, mesh: Mesh, quick: bool = False) -> np.ndarray:
        points = mesh.points[referenced_nodes(mesh)]
        if quick and numbers_of_different_points(points).max(initial=-1) + 1 == len(points):
            return NONE_FOUND
        return np.flatnonzero(_merge_targets(mesh) != np.arange(mesh.n_nodes))

    def describe(self, mesh: Mesh, where: np.ndarray) -> Finding:
        faces = np.sort(_merge_targets(mesh)[mesh.topology.boundary_faces], axis=1)
        pairs = len(faces) - len(np.unique(faces, axis=0))
        blocks = f" {pairs:,} pairs of boundary faces lie on each other: blocks that are not merged." if pairs else ""
        effect = blocks or " Hexes that should be connected may be separate there."
        return self.finding(where, f"{count_phrase(where.size, 'node lies', 'nodes lie')} on others.{effect}")

    def mend(self, mesh: Mesh) -> Mesh:
        target = _merge_targets(mesh)
        return renumber_nodes(mesh, np.unique(target, return_inverse=True)[1].reshape(-1))


@register_problem
class UnusedNodes(Problem):
    """Nodes that no cell uses."""

    name, title = "unused-nodes", "Unused nodes"
    items = "nodes"
    rank = 6
    remedy = "Remove them."
    action = "remove them"

    def locate(self, mesh: Mesh, quick: bool = False) -> np.ndarray:
        return np.flatnonzero(~referenced_nodes(mesh))

    def describe(self, mesh: Mesh, where: np.ndarray) -> Finding:
        phrase = count_phrase(where.size, "node belongs", "nodes belong")
        return self.finding(where, f"{phrase} to no cell: kept, and never moved.")

    def mend(self, mesh: Mesh) -> Mesh:
        used = referenced_nodes(mesh)
        return renumber_nodes(mesh, np.where(used, np.cumsum(used) - 1, -1))


@register_problem
class HangingNodes(Problem):
    """Nodes in the middle of an edge or face of hexes that do not use them, as between fine and coarse blocks."""

    name, title = "hanging-nodes", "Hanging nodes"
    items = "nodes"
    rank = 7
    remedy = (
        "They count as boundary nodes and stay in place, like the coarse side; a mesher with conforming transitions "
        "avoids them."
    )

    def locate(self, mesh: Mesh, quick: bool = False) -> np.ndarray:
        if quick:
            return NONE_FOUND
        faces = mesh.topology.boundary_faces
        x, is_quad = mesh.points[faces], faces[:, 2] != faces[:, 3]
        sides = (x + np.roll(x, -1, axis=1)) / 2
        at_side = np.ones(faces.shape, dtype=bool)
        at_side[~is_quad, 2] = False
        middles = np.concatenate([sides[at_side], x[is_quad].mean(axis=1)])
        nodes = np.flatnonzero(mesh.topology.boundary)
        pairs = close_pairs(np.concatenate([mesh.points[nodes], middles]), _merge_distance(mesh))
        node, middle = pairs.T
        return np.unique(nodes[node[(node < nodes.size) & (middle >= nodes.size)]])

    def describe(self, mesh: Mesh, where: np.ndarray) -> Finding:
        return self.finding(
            where,
            f"{count_phrase(where.size, 'node hangs', 'nodes hang')} in the middle of edges or faces of hexes that do "
            f"not use {'it' if where.size == 1 else 'them'}.",
        )


def _merge_distance(mesh: Mesh) -> float:
    return MERGE_DISTANCE * (mesh.mean_edge_length or 1.0)


def _merge_targets(mesh: Mesh) -> np.ndarray:
    """Number of the node into which each node is merged, the first at its position, (n,) int64.

    Two nodes of one hex are not merged, because that would collapse the hex; nor are nodes of two materials, or of a
    file with contact, where bodies touch.
    """
    n = mesh.n_nodes
    target = np.arange(n)
    if CONTACT_CARDS in mesh.field_data:
        return target
    used = np.flatnonzero(referenced_nodes(mesh))
    pairs = used[close_pairs(mesh.points[used], _merge_distance(mesh))]
    if len(pairs) and mesh.materials is not None:
        pairs = pairs[_have_one_material(mesh, pairs)]
    if not len(pairs):
        return target
    group = components(n, pairs)
    first = np.full(group.max() + 1, n)
    np.minimum.at(first, group, np.arange(n))
    target = first[group]
    broken = has_repeated_node(target[mesh.hexes]) & ~has_repeated_node(mesh.hexes)
    excluded = np.isin(target, target[mesh.hexes[broken]])
    return np.where(excluded, np.arange(n), target)


def _have_one_material(mesh: Mesh, pairs: np.ndarray) -> np.ndarray:
    """True for pairs (k, 2) of nodes that are of one material, (k,) bool.

    Nodes that no hex uses, as of faces and edges, are of the material of the hex nodes at their place if these are all
    merged into one node, and else of none.
    """
    from scipy.sparse import coo_array

    nodes, materials = mesh.hexes, mesh.materials
    if mesh.mid_nodes is not None:
        nodes = np.hstack([nodes, mesh.mid_nodes])
    hexes, place = np.nonzero(nodes >= 0)
    uses = np.ones(hexes.size), (nodes[hexes, place], materials.of_hex[hexes])
    uses = coo_array(uses, shape=(mesh.n_nodes, len(materials))).tocsr()
    one, other = (uses[pairs[:, side]] for side in (0, 1))
    by_hex = np.diff(uses.indptr)[pairs] > 0
    alike = ~by_hex.any(axis=1) | ((one * other).sum(axis=1) > 0)
    group = components(mesh.n_nodes, pairs[alike])[pairs]
    mixed = by_hex[:, 0] != by_hex[:, 1]
    of_hex, of_none = group[mixed][by_hex[mixed]], group[mixed][~by_hex[mixed]]
    least, greatest = np.full(mesh.n_nodes, mesh.n_nodes), np.full(mesh.n_nodes, -1)
    np.minimum.at(least, of_none, of_hex)
    np.maximum.at(greatest, of_none, of_hex)
    alike[mixed] = (least == greatest)[of_none]
    return alike
