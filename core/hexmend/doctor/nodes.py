"""Problems of nodes: coincident, hanging and unused nodes.

Removal of hexes and merging of nodes; data and sets of the others are kept.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from hexmend.arrays import mask
from hexmend.doctor.problem import NONE_FOUND, Finding, Problem, register_problem
from hexmend.kernels.closest_point import numbers_of_different_points
from hexmend.mesh.cells import Cells
from hexmend.mesh.collapsed_hexes import has_repeated_node, keep_hexes, renumbered_sets
from hexmend.mesh.materials import CONTACT_CARDS
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.solid_cells import solid_blocks
from hexmend.mesh.topology.close_pairs import close_pairs
from hexmend.mesh.topology.components import components
from hexmend.terminal_text import count_phrase


def extract_hexes(mesh: Mesh, kept: np.ndarray) -> Mesh:
    """Return the mesh of some cells: their nodes, and cells of lower dimension on these; sets and data are kept.

    Parameters
    ----------
    mesh : Mesh
    kept : (m,) bool
        True for the cells of `Mesh.elements` in the new mesh.

    Returns
    -------
    Mesh
    """
    ends = mesh.n_hexes + np.cumsum([0, *(len(block.nodes) for block in solid_blocks(mesh.cells))])
    of_blocks = [kept[start:end] for start, end in pairwise(ends)]
    solids = [_some_of(block, rows) for block, rows in zip(solid_blocks(mesh.cells), of_blocks, strict=True)]
    kept = kept[: mesh.n_hexes]
    used = mask(mesh.hexes[kept], mesh.n_nodes)
    if mesh.mid_nodes is not None:
        mids = mesh.mid_nodes[kept]
        used[mids[mids >= 0]] = True
    for block in solids:
        used[block.nodes] = True
    cells = (*solids, *(_some_of(c, used[c.nodes].all(axis=1)) for c in mesh.cells if c.dimension < 3))
    part = keep_hexes(mesh.rebuilt(cells=tuple(c for c in cells if len(c.nodes))), kept)
    return renumber_nodes(part, np.where(used, np.cumsum(used) - 1, -1))


def _some_of(cells: Cells, kept: np.ndarray) -> Cells:
    """Cells that are marked in `kept`, (k,) bool, with their data and sets."""
    data = {name: values[kept] for name, values in cells.data.items()}
    return Cells(
        cells.kind, cells.nodes[kept], data, renumbered_sets(cells.sets, np.where(kept, np.cumsum(kept) - 1, -1))
    )


def renumber_nodes(mesh: Mesh, target: np.ndarray) -> Mesh:
    """Return the mesh with its nodes renumbered, merged or removed.

    Parameters
    ----------
    mesh : Mesh
    target : (n,) int
        New number of each node; nodes of one number are merged into the first of them, nodes of -1 removed.

    Returns
    -------
    Mesh
    """
    kept, first = np.unique(target, return_index=True)
    first = first[kept >= 0]
    mids = mesh.mid_nodes
    rebuilt = mesh.rebuilt(
        points=mesh.points[first],
        hexes=target[mesh.hexes],
        mid_nodes=None if mids is None else np.where(mids >= 0, target[mids], -1),
        pinned=None if mesh.pinned is None else np.isin(np.arange(len(first)), target[mesh.pinned]),
        node_data={name: values[first] for name, values in mesh.node_data.items()},
        node_sets=renumbered_sets(mesh.node_sets, target),
        cells=tuple(Cells(c.kind, target[c.nodes].astype(np.int32), c.data, c.sets) for c in mesh.cells),
    )
    own = mesh.without_motion_of_rules()  # the rules name nodes as they were, and are gone
    motion = own.linear_motion
    return rebuilt if motion is None else rebuilt.with_linear_motion(motion.renumbered(target), own.motion_start[first])


def referenced_nodes(mesh: Mesh) -> np.ndarray:
    """Return True for nodes that a hex (as corner or mid-node), another cell, a named set or a pin uses, (n,) bool."""
    used = mesh.topology.used.copy()
    if mesh.pinned is not None:  # such as the reference node of a rigid body
        used |= mesh.pinned
    if mesh.mid_nodes is not None:
        used[mesh.mid_nodes[mesh.mid_nodes >= 0]] = True
    for cells in mesh.cells:
        used[cells.nodes] = True
    for members in mesh.node_sets.values():  # such as a reference point
        used[members] = True
    return used


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
    remedy = "Where fine faces cover a coarse one they move with its nodes; others count as boundary nodes and stay."

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
        still = nodes[node[(node < nodes.size) & (middle >= nodes.size)]]
        return np.unique(np.concatenate([mesh.topology.hanging[:, 0], still]))

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
