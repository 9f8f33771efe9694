"""Frames: everything that a view draws of a mesh, as one value."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from hexmend.boundary.displacement import Displacement
from hexmend.mesh.mesh import Mesh
from hexmend.quality import ElementQuality
from hexmend_app.picture.appearance import Look


@dataclass(frozen=True, eq=False)
class Frame:
    """A mesh with the data and the look that it is drawn with.

    What draws frames compares each with the last one: the mesh's arrays, the figures and the movement by identity, the
    look by what it says.

    Parameters
    ----------
    mesh : Mesh
    figures : ElementQuality
        Of the mesh.
    movement : Displacement, optional
        Movement for colours and arrows; None if the look shows none.
    look : Look
    original : (n, 3) float64, optional
        Positions of the nodes when the mesh was opened, for the layer that shows that boundary.
    kinds : (n,) uint8, optional
        Class of each node on the boundary, see `hexmend_app.state.tasks.boundary_classifier.node_kinds`, if the look
        shows it; found if absent.
    """

    mesh: Mesh
    figures: ElementQuality
    movement: Displacement | None = None
    look: Look = field(default_factory=Look)
    original: np.ndarray | None = None
    kinds: np.ndarray | None = None

    def is_of(self, other: Frame | None) -> bool:
        """Return True if both frames show the same hexes, with nodes at any positions."""
        return other is not None and self.mesh.hexes is other.mesh.hexes

    def neighbour(self, first: Frame) -> Frame:
        """Return the frame of this mesh under the look of another frame, for a view beside it.

        It compares with the same moment.
        """
        movement = first.movement
        if not same_hexes(first.mesh, self.mesh):
            return Frame(self.mesh, self.figures, None, first.look)
        if movement is not None:
            known = self.movement
            then = movement.before
            alike = known is not None and known.before.points is then.points and known.before.name == then.name
            movement = known if alike else movement.updated(self.mesh.points, self.figures)
        return Frame(self.mesh, self.figures, movement, first.look, first.original, first.kinds)


def same_hexes(one: Mesh, other: Mesh) -> bool:
    """Return True if two meshes have equal hexes, so that numbers of hexes mean the same in both."""
    return one.hexes is other.hexes or np.array_equal(one.hexes, other.hexes)
