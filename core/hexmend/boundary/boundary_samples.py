"""Samples of a boundary: edge midpoints, face centres and nodes, those of its interfaces apart."""

from __future__ import annotations

import numpy as np

from hexmend.arrays import mask
from hexmend.boundary.edges import SurfaceEdges


def samples_of_faces(faces: np.ndarray, n: int, edges: np.ndarray | None = None) -> np.ndarray:
    """Return the samples of quads: midpoints of edges (with each node twice) and of faces, then the nodes themselves.

    Parameters
    ----------
    faces : (k, 4) int32
    n : int
        Number of nodes of the mesh.
    edges : (e, 2) int32, optional
        Edges of the faces, where they are known already.

    Returns
    -------
    (s, 4) int32
        Four nodes whose mean each sample is.
    """
    edges = SurfaceEdges(faces, n).nodes if edges is None else edges
    nodes = np.tile(np.flatnonzero(mask(faces, n))[:, None], 4)
    return np.ascontiguousarray(np.concatenate([np.tile(edges, 2), faces, nodes]), dtype=np.int32)


def samples_and_groups(
    faces: np.ndarray, edges: np.ndarray, n: int, inner: np.ndarray | None
) -> tuple[np.ndarray, np.ndarray]:
    """Return the samples of a boundary, then those of its interfaces, and the group of each.

    Parameters
    ----------
    faces : (k, 4) int32
    edges : (e, 2) int32
        Edges of the faces.
    n : int
        Number of nodes of the mesh.
    inner : (k,) bool or None
        Faces of interfaces; None where there are none. Edges and nodes at which they end are sampled twice.

    Returns
    -------
    samples : (s, 4) int32
        See `samples_of_faces`.
    groups : (s,) int64
        0 for the boundary, 1 for interfaces.
    """
    if inner is None:
        samples = samples_of_faces(faces, n, edges)
        return samples, np.zeros(len(samples), dtype=np.int64)
    parts = [samples_of_faces(faces[which], n) for which in (~inner, inner)]
    return np.concatenate(parts), np.repeat(np.arange(2), [len(samples) for samples in parts])
