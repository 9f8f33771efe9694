"""Sliding nodes of a coarse mesh: they slide on the surface of the fine one."""

from __future__ import annotations

import numpy as np

from hexmend.arrays import mask
from hexmend.boundary import SlidingBoundary
from hexmend.boundary.classification import Boundary
from hexmend.boundary.sliding import SlidingNodes
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.topology.refinement import Refinement


class CoarseSliding(SlidingNodes):
    """Nodes of the coarse mesh that slide, each on the curve or patch on which it slides in the fine mesh.

    Coarse faces that are turned over are rejected; how far they are from the surface does not matter.

    Parameters
    ----------
    fine : SlidingBoundary
    refinement : Refinement
        Of its mesh.
    mesh : Mesh
        The coarse mesh, in which nodes of flat patches and straight curves have a linear motion.

    Attributes
    ----------
    mesh, linear_mesh : Mesh
        The coarse mesh.
    curved_nodes : (k,) int64
        Sliding nodes without a linear motion, ascending.
    """

    def __init__(self, fine: SlidingBoundary, refinement: Refinement, mesh: Mesh):
        vertices, number, n = refinement.vertices, refinement.number, refinement.n_nodes
        middle, faces = refinement.faces_around(mask(fine.boundary.faces, n))
        patch = np.empty(n, dtype=np.int32)
        patch[fine.boundary.faces] = fine.boundary.patch_of_face[:, None]
        of_nodes = fine.boundary
        boundary = Boundary(
            of_nodes.node_class[vertices],
            of_nodes.component[vertices],
            faces,
            patch[middle],
            np.empty((0, 2), np.int32),
            np.empty(0, np.int32),
        )
        nodes = number[fine.nodes[number[fine.nodes] >= 0]].astype(np.int64)
        curved = number[fine.curved_nodes[number[fine.curved_nodes] >= 0]].astype(np.int64)
        super().__init__(boundary, fine.surface.on_nodes(vertices), nodes, fine.points[vertices])
        self.mesh = self.linear_mesh = mesh
        self.curved_nodes = curved
