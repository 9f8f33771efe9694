"""A mesh that a page shows."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.boundary.displacement import Displacement
from hexmend.mesh.mesh import Mesh
from hexmend.quality import ElementQuality, measure
from hexmend_app.scene.frame import Frame
from hexmend_app.state.look import Look


@dataclass(frozen=True, eq=False)
class Subject:
    """A mesh with what is known of it.

    Parameters
    ----------
    name : str
        What its caption calls it.
    mesh : Mesh
    figures : ElementQuality
        Of the mesh.
    movement, original, kinds
        As in a `Frame`; of the first of several, with whose movement the others compare.
    """

    name: str
    mesh: Mesh
    figures: ElementQuality
    movement: Displacement | None = None
    original: np.ndarray | None = None
    kinds: np.ndarray | None = None

    @classmethod
    def of(cls, mesh: Mesh, name: str = "") -> Subject:
        """A mesh that is yet to be measured; without a name, its own."""
        return cls(name or mesh.name, mesh, measure(mesh.points, mesh.hexes))

    @classmethod
    def shown(cls, frame: Frame, name: str = "") -> Subject:
        """What a frame shows."""
        return cls(name, frame.mesh, frame.figures, frame.movement, frame.original, frame.kinds)

    def frame(self, look: Look) -> Frame:
        """The mesh under a look."""
        return Frame(self.mesh, self.figures, self.movement, look, self.original, self.kinds)

    @property
    def said(self) -> str:
        """What its caption says beside the name."""
        inverted = self.figures.n_inverted
        return f"q min {self.figures.q.min():.4f}, {f'{inverted:,}' if inverted else 'none'} inverted"
