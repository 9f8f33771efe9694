"""Curved faces of second-order hexes, divided into quads on which the boundary slides.

Triangles between the corners alone would leave a curved surface by the sagitta of its chords.

Flat patches and straight curves of a boundary, and the linear motion of nodes that slide on them.
"""

from __future__ import annotations

from dataclasses import replace
from math import isqrt
from typing import NamedTuple

import numpy as np

from hexmend.arrays import mask
from hexmend.boundary.classification import Boundary, NodeClass
from hexmend.boundary.edges import SurfaceEdges
from hexmend.boundary.skin_faces import skin_faces
from hexmend.boundary.surface import PartitionedSurface
from hexmend.boundary.tolerances import ROUNDING
from hexmend.mesh.linear_motion import LinearMotion
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.second_order.curved_geometry import evaluate_quads, grid, quad_nodes
from hexmend.mesh.second_order.mid_node_lookup import face_mid_nodes


class FlatPart(NamedTuple):
    """Flat patch or straight curve.

    Parameters
    ----------
    nodes : (k,) int
        Its nodes, with those of its rim, ascending.
    directions : (3, d) float64
        Orthonormal directions in which it extends, in columns: two of a patch, one of a curve.
    """

    nodes: np.ndarray
    directions: np.ndarray


def flat_parts(points: np.ndarray, boundary: Boundary, mean_edge: float) -> list[FlatPart]:
    """Find the flat patches and straight curves of a boundary: no node is further than `ROUNDING` from them.

    Parameters
    ----------
    points : (n, 3) float64
        Node positions.
    boundary : Boundary
    mean_edge : float
        Mean edge length of the mesh.

    Returns
    -------
    list of FlatPart
        Patches first.
    """
    found = []
    kinds = (boundary.faces, boundary.patch_of_face, 2), (boundary.segments, boundary.curve_of_segment, 1)
    for pieces, part, dimensions in kinds:
        order = np.argsort(part, kind="stable")
        starts = np.flatnonzero(np.diff(part[order])) + 1
        for of_part in np.split(pieces[order], starts) if part.size else ():
            nodes = np.unique(of_part)
            x = points[nodes] - points[nodes].mean(axis=0)
            directions = np.linalg.eigh(x.T @ x)[1]  # by ascending extent
            if np.abs(x @ directions[:, : 3 - dimensions]).max() <= ROUNDING * mean_edge:
                found.append(FlatPart(nodes, directions[:, 3 - dimensions :]))
    return found


def flat_motion(points: np.ndarray, boundary: Boundary, sliding: np.ndarray, mean_edge: float) -> LinearMotion:
    """Restrict sliding nodes (k,) int on flat patches to their planes, and those on straight curves to their lines.

    A node keeps its distance from the plane or line.

    Parameters
    ----------
    points, boundary, mean_edge
        See `flat_parts`.
    sliding : (k,) int
        Nodes that slide: others, such as corners, get no linear motion.

    Returns
    -------
    LinearMotion
    """
    slides, nodes, projectors = mask(sliding, len(points)), [], []
    for part in flat_parts(points, boundary, mean_edge):
        own_class = NodeClass.PATCH if part.directions.shape[1] == 2 else NodeClass.CURVE
        own = part.nodes[slides[part.nodes] & (boundary.node_class[part.nodes] == own_class)]
        nodes.append(own)
        projectors.append(np.tile(part.directions @ part.directions.T, (own.size, 1, 1)))
    if not nodes:
        return LinearMotion()
    return LinearMotion(np.concatenate(nodes), np.concatenate(projectors))


#: Largest sagitta of a chord between the points of divided edges, in lengths of the edges.
_MAX_SAGITTA = 1e-3
#: Most quads of divided faces, of which each takes about 850 bytes, unless two divisions of an edge make more.
_MAX_QUADS = 1 << 18


def surface_of_boundary(mesh: Mesh, points: np.ndarray, boundary: Boundary) -> PartitionedSurface:
    """Return the surface of a boundary: of its faces, or of the parts of curved ones.

    All edges have as many divisions as the most curved one needs, fewer where there are many faces. Nothing is divided,
    and nodes slide on triangles between the corners, if a face has collapsed (two of its corners are one node), and in
    a mesh with other cells than hexes.

    Parameters
    ----------
    mesh : Mesh
    points : (n, 3) float64
        Positions of all nodes.
    boundary : Boundary
        With all faces of `skin_faces`.

    Returns
    -------
    PartitionedSurface
    """
    faces, n = boundary.faces, len(points)
    only_hexes = mesh.n_hexes == mesh.n_elements
    if mesh.mid_nodes is None or not only_hexes or (np.diff(np.sort(faces, axis=1), axis=1) == 0).any():
        return PartitionedSurface(points, boundary)
    mids = face_mid_nodes(mesh.elements, mesh.mid_nodes, skin_faces(mesh).hexes[:, 0], faces)
    nodes = quad_nodes(points, faces, mids)
    ends, after = nodes[:, :4], nodes[:, [1, 2, 3, 0]]
    sagitta = np.linalg.norm(nodes[:, 4:8] - (ends + after) / 2, axis=2)
    length = np.linalg.norm(after - ends, axis=2)
    share = float((sagitta / np.where(length > 0, length, np.inf)).max(initial=0.0))
    most = max(2, isqrt(_MAX_QUADS // max(len(faces), 1)))
    divisions = int(min(np.ceil(np.sqrt(share / _MAX_SAGITTA)), most))
    if divisions < 2:
        return PartitionedSurface(points, boundary)
    edges, inner = SurfaceEdges(faces, n), np.arange(divisions - 1)
    lattice = _lattice(faces, edges, divisions)
    vertices = np.empty((lattice.max() + 1, 3))
    vertices[:n] = points
    vertices[lattice.reshape(len(faces), -1)] = evaluate_quads(nodes, grid(divisions))
    vertices[faces] = points[faces]
    one, other = slice(None, -1), slice(1, None)
    at = (one, one), (one, other), (other, other), (other, one)
    quads = np.stack([lattice[:, v, u] for v, u in at], axis=-1).reshape(-1, 4)
    segments = boundary.segments
    on_edge = n + np.searchsorted(edges.key, edges.keys_of(segments))[:, None] * inner.size + inner
    chain = np.column_stack([segments.min(axis=1), on_edge, segments.max(axis=1)])
    more = len(vertices) - n
    node_class = np.concatenate([boundary.node_class, np.full(more, NodeClass.INSIDE, boundary.node_class.dtype)])
    component = np.concatenate([boundary.component, np.full(more, -1, boundary.component.dtype)])
    node_class[on_edge], component[on_edge] = NodeClass.CURVE, boundary.curve_of_segment[:, None]
    divided = replace(
        boundary,
        node_class=node_class,
        component=component,
        faces=quads.astype(np.int32),
        patch_of_face=np.repeat(boundary.patch_of_face, divisions**2),
        segments=np.sort(np.stack([chain[:, :-1], chain[:, 1:]], axis=-1).reshape(-1, 2), axis=1).astype(np.int32),
        curve_of_segment=np.repeat(boundary.curve_of_segment, divisions),
    )
    return PartitionedSurface(vertices, divided).on_nodes(np.arange(n))


def _lattice(faces: np.ndarray, edges: SurfaceEdges, divisions: int) -> np.ndarray:
    """Number the points of divided faces, (k, divisions + 1, divisions + 1): nodes, then those on edges and in faces.

    Points on an edge follow each other from its lower node on, those in a face as in `curved_geometry.grid`.
    """
    inner, last = np.arange(divisions - 1), divisions
    sides = np.stack([faces, np.roll(faces, -1, axis=1)], axis=-1)
    along = edges.n + np.searchsorted(edges.key, edges.keys_of(sides))[..., None] * inner.size + inner
    along = np.where((sides[..., 0] < sides[..., 1])[..., None], along, along[..., ::-1])
    number = np.empty((len(faces), divisions + 1, divisions + 1), dtype=np.int64)
    number[:, [0, 0, last, last], [0, last, last, 0]] = faces
    number[:, 0, 1:last], number[:, 1:last, last] = along[:, 0], along[:, 1]
    number[:, last, 1:last], number[:, 1:last, 0] = along[:, 2, ::-1], along[:, 3, ::-1]
    first = edges.n + len(edges.key) * inner.size
    number[:, 1:last, 1:last] = first + np.arange(len(faces) * inner.size**2).reshape(-1, inner.size, inner.size)
    return number
