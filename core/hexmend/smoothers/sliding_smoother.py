"""What methods share whose boundary nodes stay, or slide on the surface, as they are told: 5.2.1."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.mesh import Mesh
from hexmend.parameters import parameter
from hexmend.smoothers.smoother import Smoother
from hexmend.surface import Sliding


@dataclass(frozen=True)
class SlidingSmoother(Smoother):
    """A method that may let the nodes of the boundary slide on the surface, which they never leave."""

    boundary: str = parameter(
        "fixed", choices=("fixed", "slide"), help="Whether nodes of the boundary stay, or slide on the surface (5.2.1)."
    )
    feature_angle: float = parameter(
        40.0, low=1, high=180, unit="degrees", help="Along edges at which the boundary turns by more nodes only slide."
    )

    @property
    def slides(self) -> bool:
        return self.boundary == "slide"

    def movable(self, mesh: Mesh) -> np.ndarray:
        sliding = self.sliding(mesh)
        return mesh.free if sliding is None else sliding.mesh.free

    def sliding(self, mesh: Mesh) -> Sliding | None:
        """What the nodes of a mesh's boundary slide on; None where they stay."""
        return Sliding(mesh, self.feature_angle) if self.slides else None
