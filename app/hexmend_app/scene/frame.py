"""What is to be seen of a mesh, as one value."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from hexmend.boundary.displacement import Displacement
from hexmend.mesh.mesh import Mesh
from hexmend.quality import ElementQuality
from hexmend_app.state.look import Look


@dataclass(frozen=True, eq=False)
class Frame:
    """A mesh with its nodes where they are drawn, and how.

    What draws frames compares each with the last one: the mesh's arrays, the figures and the movement by identity, the
    look by what it says.

    Parameters
    ----------
    mesh : Mesh
    figures : ElementQuality
        Of the mesh.
    movement : Displacement, optional
        What colours and arrows of a movement show; None where nothing of a movement is looked at.
    look : Look
    original : (n, 3) float64, optional
        Where the nodes were when the mesh was opened, for a look that shows that boundary.
    kinds : (n,) uint8, optional
        What each node is to the boundary, see `hexmend_app.state.classer.node_kinds`, for a look that shows that; where
        there are none, they are found.
    """

    mesh: Mesh
    figures: ElementQuality
    movement: Displacement | None = None
    look: Look = field(default_factory=Look)
    original: np.ndarray | None = None
    kinds: np.ndarray | None = None

    def is_of(self, other: Frame | None) -> bool:
        """Whether it shows the very mesh of another frame, its nodes elsewhere or not."""
        return other is not None and self.mesh.hexes is other.mesh.hexes

    def beside(self, first: Frame) -> Frame:
        """What a view beside that of another frame draws: this mesh as the other frame has its own looked at.

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
    """Whether two meshes have the same hexes, so that what is said of one's elements holds for the other's."""
    return one.hexes is other.hexes or np.array_equal(one.hexes, other.hexes)
