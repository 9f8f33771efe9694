"""Normals of the surface at the boundary's quads, each on the quad's own patch."""

from __future__ import annotations

import numpy as np

from hexmend.boundary.classification import NodeClass
from hexmend.boundary.closest_point import ClosestPointCache
from hexmend.boundary.normals import directions_of_means
from hexmend.boundary.sliding.sliding_boundary import SlidingBoundary


class QuadNormals:
    """Outward unit normals of the surface on which a boundary slides, at the boundary's quads.

    That of a quad is the mean over its corners, each at the closest point of the patch of the quad: nodes on curves are
    on several. On a target surface it is the patch on which a node of the quad slides. A quad without one, or around
    which the surface turns back, keeps the normal of the original boundary.

    Parameters
    ----------
    sliding : SlidingBoundary
        The quads are the faces of its `boundary`.
    """

    def __init__(self, sliding: SlidingBoundary):
        self._surface, self._faces, self._outward = sliding.surface, sliding.boundary.faces, sliding.outward
        patch = sliding.boundary.patch_of_face
        if sliding.mesh.target is not None:
            on_patch = sliding.node_class[self._faces] == NodeClass.PATCH
            patches = np.where(on_patch, sliding.surface.component[self._faces], -1)
            patch = patches.max(axis=1, initial=-1)
        self._quads = np.flatnonzero(patch >= 0)
        self._cache = ClosestPointCache(sliding.surface.trees, np.repeat(patch[self._quads], 4))

    def __call__(self, points: np.ndarray) -> np.ndarray:
        """Compute the normals with the nodes at some points.

        Parameters
        ----------
        points : (n, 3) float64
            In the mesh's unit of length.

        Returns
        -------
        (f, 3) float64
            0 where neither the surface nor the original boundary has a normal.
        """
        at, outward = self._quads, self._outward[self._quads]
        found = self._cache.closest(points[self._faces[at].ravel()])
        mean = self._surface.directions(found).reshape(-1, 4, 3).mean(axis=1)
        side = np.where(np.einsum("fi,fi->f", mean, outward) < 0, -1, 1)  # triangles of a file may face either way
        normals = self._outward.copy()
        normals[at] = directions_of_means(side[:, None] * mean, outward)
        return normals
