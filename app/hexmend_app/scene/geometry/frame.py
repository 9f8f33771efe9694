"""Frames: all data that a view draws of a mesh."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from hexmend.mesh.mesh import Mesh
from hexmend.quality import ElementQuality
from hexmend_app.picture.appearance import Look
from hexmend_app.picture.displacement import Displacement


@dataclass(frozen=True, eq=False)
class Frame:
    """A mesh with its data and the look that it is drawn with.

    Views compare each frame with the last one: arrays of the mesh, figures and movement by identity, looks by value.

    Parameters
    ----------
    mesh : Mesh
    quality : ElementQuality
        Quality of the mesh.
    movement : Displacement, optional
        Movement for colours and arrows; None if the look shows none.
    look : Look
    original : (n, 3) float64, optional
        Positions of the nodes when the mesh was opened, for the layer of the original surface.
    kinds : (n,) uint8, optional
        Class of each boundary node, see `hexmend_app.state.tasks.boundary_classifier.node_classes`; None computes the
        classes if the look shows them.
    original_kinds : (n,) uint8, optional
        Classes for the same mesh with other positions, where other nodes have left the original boundary.
    """

    mesh: Mesh
    quality: ElementQuality
    movement: Displacement | None = None
    look: Look = field(default_factory=Look)
    original: np.ndarray | None = None
    kinds: np.ndarray | None = None
    original_kinds: np.ndarray | None = None

    @property
    def curved(self) -> bool:
        """True if faces and edges are drawn curved along the mid-nodes of the mesh."""
        return self.mesh.mid_nodes is not None and self.look.structure.is_on("curved")

    def is_of(self, other: Frame | None) -> bool:
        """Return True if both frames share their hexes with their mid-nodes; positions of nodes may differ."""
        if other is None:
            return False
        return self.mesh.elements is other.mesh.elements and self.mesh.mid_nodes is other.mesh.mid_nodes

    def matching(self, first: Frame) -> Frame:
        """Return a frame of this mesh with the look and the reference state of movement of the first view's frame."""
        movement = first.movement
        if not same_hexes(first.mesh, self.mesh):
            return Frame(self.mesh, self.quality, None, first.look)
        if movement is not None:
            known, reference = self.movement, movement.before
            unchanged = known is not None and (
                known.before.points is reference.points and known.before.name == reference.name
            )
            movement = known if unchanged else movement.updated(self.mesh.points, self.quality)
        kinds = first.kinds
        if self.mesh.points is not first.mesh.points and first.original_kinds is not None:
            kinds = first.original_kinds
        return Frame(self.mesh, self.quality, movement, first.look, first.original, kinds, first.original_kinds)


def same_hexes(mesh: Mesh, other: Mesh) -> bool:
    """Return True if two meshes have equal hexes, so that hex numbers are valid in both."""
    return mesh.elements is other.elements or np.array_equal(mesh.elements, other.elements)
