"""Positions of the copies of nodes under a layer, before the mesh is mended."""

from __future__ import annotations

import numpy as np

from hexmend.boundary.normals import unit_vectors
from hexmend.locking.locked_corners import inward_direction
from hexmend.mesh.hexahedron import EDGES, FACES
from hexmend.mesh.materials import Materials
from hexmend.padding.inserted_layer import Sheet

#: Thickness of a layer by default, in lengths of the edges behind it.
DEFAULT_THICKNESS = 1 / 3
#: Largest displacement of a copy, in lengths of the shortest edge behind it.
_MAX_DISPLACEMENT = 0.4
#: Weight of the least length against the planes at a given distance, among which a node moves.
_REGULARISATION = 1e-4
#: Least share of the thickness by which a copy is to be below each face.
_MIN_SHARE = 0.1
#: Least length by which a vector is divided.
_TINY = 1e-150


def displacements(sheet: Sheet, thickness: float | None = None) -> np.ndarray:
    """Find displacements of the copies from their nodes into the mesh.

    A copy goes to the distance of the thickness from the planes of its faces, in the least squares. On an interface
    and at the rim of a layer it goes along the edges behind it, so that it stays on the interface or the boundary.

    Parameters
    ----------
    sheet : Sheet
    thickness : float, optional
        In the mesh's unit of length; a third of the edges behind each node by default. No displacement is longer than
        0.4 of the shortest edge behind it.

    Returns
    -------
    (c, 3) float64
    """
    x, originals = sheet.mesh.points, sheet.originals
    copies, ends = _edges_behind(sheet)
    kept, along = _guiding_edges(sheet, copies, ends)
    length = np.linalg.norm(x[ends] - x[originals[copies]], axis=1)
    mean, shortest = _mean(copies, length, len(originals)), np.full(len(originals), np.inf)
    np.minimum.at(shortest, copies, length)
    own = _face_edges(sheet)
    mean = np.where(np.isfinite(shortest), mean, own)
    shortest = np.where(np.isfinite(shortest), shortest, np.sqrt(3) * own)  # the way in is a diagonal
    depth = DEFAULT_THICKNESS * mean if thickness is None else np.full(len(originals), thickness)
    moves = _below_faces(sheet, depth)
    towards = (x[ends] - x[originals[copies]])[kept]
    guided = _mean(copies[kept], towards, len(originals))
    share = np.minimum(depth / np.maximum(np.linalg.norm(guided, axis=1), _TINY), 1.0)
    moves = np.where(along[:, None], share[:, None] * guided, moves)
    size = np.linalg.norm(moves, axis=1)
    return moves * np.minimum(1.0, _MAX_DISPLACEMENT * shortest / np.maximum(size, _TINY))[:, None]


def _edges_behind(sheet: Sheet) -> tuple[np.ndarray, np.ndarray]:
    """Edges from copies to what lies behind the layer, each once: the copy (j,), and the node at the other end (j,).

    These are all edges of hexes at a copy but those of its own faces.
    """
    mesh, copies = sheet.mesh, sheet.copy_of_corner
    hexes = np.flatnonzero((copies >= 0).any(axis=1))
    both = np.concatenate([EDGES, EDGES[:, ::-1]])
    own, other = copies[hexes][:, both].reshape(-1, 2).T
    node = mesh.hexes[hexes][:, both[:, 1]].ravel()
    faces = sheet.edges
    width = len(sheet.originals) + 1
    of_face = np.isin(np.minimum(own, other) * width + np.maximum(own, other), faces[:, 0] * width + faces[:, 1])
    found = np.unique(np.stack([own, node], axis=1)[(own >= 0) & ~((other >= 0) & of_face)], axis=0)
    return found[:, 0], found[:, 1]


def _guiding_edges(sheet: Sheet, copies: np.ndarray, ends: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Edges behind the layer that guide copies on interfaces and at the rim.

    Returns
    -------
    kept : (j,) bool
        True for the guiding edges.
    along : (c,) bool
        True for the copies that have one.
    """
    count = len(sheet.originals)
    kept, along = np.zeros(copies.size, dtype=bool), np.zeros(count, dtype=bool)
    materials = sheet.mesh.materials
    if materials is not None:
        at_edge = _materials_at(materials, sheet.originals[copies], ends)
        most = np.ones(count, dtype=np.int64)
        np.maximum.at(most, copies, at_edge)
        along = most > 1
        kept = along[copies] & (at_edge == most[copies])
    rim = np.zeros(count, dtype=bool)
    face, side = sheet.rim.T
    inner = sheet.new_hexes[:, :4].astype(np.int64) - sheet.mesh.n_nodes
    rim[inner[face, side]] = rim[inner[face, (side + 1) % 4]] = True
    if rim.any():
        on_rest = _on_other_boundary(sheet, copies, ends)
        kept = np.where(rim[copies], on_rest, kept)
        along |= rim
    return kept, along & (np.bincount(copies[kept], minlength=count) > 0)


def _materials_at(materials: Materials, nodes: np.ndarray, ends: np.ndarray) -> np.ndarray:
    """Count the materials of the hexes around edges between nodes (j,) and ends (j,), (j,) int64."""
    n = materials.topology.n
    keys = np.minimum(nodes, ends) * n + np.maximum(nodes, ends)
    pairs = np.sort(materials.topology.hexes[:, EDGES].astype(np.int64), axis=2)
    of_edges = (pairs[..., 0] * n + pairs[..., 1]).ravel()
    wanted = np.isin(of_edges, keys)
    found = np.unique(
        np.stack([of_edges[wanted], np.repeat(materials.of_hex[: len(materials.topology.hexes)], 12)[wanted]], axis=1),
        axis=0,
    )
    edge, count = np.unique(found[:, 0], return_counts=True)
    return count[np.searchsorted(edge, keys)]


def _on_other_boundary(sheet: Sheet, copies: np.ndarray, ends: np.ndarray) -> np.ndarray:
    """Mark the edges that are edges of boundary faces outside the sheet, (j,) bool."""
    mesh = sheet.mesh
    hexes, faces = np.nonzero((mesh.topology.hex_neighbours < 0) & ~sheet.is_padded)
    quads = mesh.hexes[hexes[:, None], FACES[faces]].astype(np.int64)
    sides = np.sort(np.stack([quads, np.roll(quads, -1, axis=1)], axis=-1).reshape(-1, 2), axis=1)
    nodes = sheet.originals[copies]
    keys = np.minimum(nodes, ends) * mesh.n_nodes + np.maximum(nodes, ends)
    return np.isin(keys, sides[:, 0] * mesh.n_nodes + sides[:, 1])


def _below_faces(sheet: Sheet, depth: np.ndarray) -> np.ndarray:
    """Displacements to a depth (c,) below the planes of the faces at each copy, (c, 3) float64."""
    x, quads = sheet.mesh.points, sheet.quads
    inner = sheet.new_hexes[:, :4].astype(np.int64) - sheet.mesh.n_nodes
    at, count = inner.ravel(), len(sheet.originals)
    ahead, back = np.roll(quads, -1, axis=1), np.roll(quads, 1, axis=1)
    normals = unit_vectors(np.cross(x[ahead] - x[quads], x[back] - x[quads]).reshape(-1, 3))
    matrix = np.zeros((count, 3, 3))
    np.add.at(matrix, at, normals[:, :, None] * normals[:, None, :])
    total = np.zeros((count, 3))
    np.add.at(total, at, normals)
    faces = np.maximum(np.bincount(at, minlength=count), 1)
    matrix += (_REGULARISATION * faces)[:, None, None] * np.eye(3)
    moves = -depth[:, None] * np.linalg.solve(matrix, total[:, :, None])[:, :, 0]
    least = np.full(count, np.inf)
    np.minimum.at(least, at, -np.einsum("ki,ki->k", moves[at], normals))
    poor = np.flatnonzero(least < _MIN_SHARE * depth)
    if poor.size:
        middle = unit_vectors(_mean_of_hexes(sheet))
        order = np.argsort(at, kind="stable")
        first = np.searchsorted(at[order], [poor, poor + 1])
        for copy, start, end in zip(poor, *first, strict=True):
            direction, sine = inward_direction(normals[order[start:end]])
            moves[copy] = depth[copy] * (direction if sine > 0 else middle[copy])
    return moves


def _mean_of_hexes(sheet: Sheet) -> np.ndarray:
    """Vector from each copy to the mean of the centres of its hexes, (c, 3) float64."""
    mesh = sheet.mesh
    hexes, corners = np.nonzero(sheet.copy_of_corner >= 0)
    centres = mesh.points[mesh.hexes[hexes]].mean(axis=1)
    mean = _mean(sheet.copy_of_corner[hexes, corners], centres, len(sheet.originals))
    return mean - mesh.points[sheet.originals]


def _face_edges(sheet: Sheet) -> np.ndarray:
    """Mean length of the edges of faces at each copy, (c,) float64."""
    x = sheet.mesh.points[sheet.originals]
    one, other = sheet.edges.T
    length = np.linalg.norm(x[one] - x[other], axis=1)
    return _mean(np.concatenate([one, other]), np.tile(length, 2), len(x))


def _mean(at: np.ndarray, values: np.ndarray, count: int) -> np.ndarray:
    """Mean of the values (j, ...) at each of `count` places, 0 without any."""
    sums = np.zeros((count, *values.shape[1:]))
    np.add.at(sums, at, values)
    number = np.maximum(np.bincount(at, minlength=count), 1)
    return sums / number.reshape(-1, *[1] * (values.ndim - 1))


def neighbours_behind(sheet: Sheet, moves: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Find the node behind each copy, and the place of the copy on the way to it.

    Parameters
    ----------
    sheet : Sheet
    moves : (c, 3) float64
        Displacements of the copies.

    Returns
    -------
    nodes : (c,) int64
        Lowest node at the other end of an edge behind the layer; the copy's own node where there is none.
    share : (c,) float64
        Length of the displacement over that of the edge, at most 1.
    """
    x, nodes = sheet.mesh.points, sheet.originals.copy()
    copies, ends = _edges_behind(sheet)
    own, first = np.unique(copies, return_index=True)
    nodes[own] = ends[first]
    length = np.linalg.norm(x[nodes] - x[sheet.originals], axis=1)
    share = np.linalg.norm(moves, axis=1) / np.where(length > 0, length, np.inf)
    return nodes, np.minimum(share, 1.0)
