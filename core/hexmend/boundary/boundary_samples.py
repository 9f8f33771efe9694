"""Samples of a boundary: edge midpoints, face centres and nodes."""

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
