"""Meshes of a page."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.mesh.mesh import Mesh
from hexmend.quality import ElementQuality, measure
from hexmend_app.picture.appearance import Look
from hexmend_app.picture.displacement import Displacement
from hexmend_app.scene.geometry.frame import Frame
from hexmend_app.state.mesh.hex_groups import invalid_counts


@dataclass(frozen=True, eq=False)
class PageMesh:
    """Mesh of a page with its quality, movement and name.

    Parameters
    ----------
    name : str
        Name in the caption.
    mesh : Mesh
    figures : ElementQuality
        Quality of the mesh.
    movement, original, kinds, original_kinds
        As in `Frame`; set for the first of several meshes only, whose reference state the others use.
    """

    name: str
    mesh: Mesh
    figures: ElementQuality
    movement: Displacement | None = None
    original: np.ndarray | None = None
    kinds: np.ndarray | None = None
    original_kinds: np.ndarray | None = None

    @classmethod
    def of(cls, mesh: Mesh, name: str = "") -> PageMesh:
        """Return a mesh with its measured quality, under its own name by default."""
        return cls(name or mesh.name, mesh, measure(mesh.points, mesh.hexes, mesh.mid_nodes))

    @classmethod
    def shown(cls, frame: Frame, name: str = "") -> PageMesh:
        """Return the mesh of a frame with its data."""
        kinds = frame.kinds, frame.original_kinds
        return cls(name, frame.mesh, frame.figures, frame.movement, frame.original, *kinds)

    def frame(self, look: Look) -> Frame:
        """Return the frame of the mesh with a look."""
        return Frame(self.mesh, self.figures, self.movement, look, self.original, self.kinds, self.original_kinds)

    @property
    def text(self) -> str:
        """Figures of the caption: smallest q and number of invalid hexes."""
        return f"q min {self.figures.q.min():.4f}, {invalid_counts(self.figures.n_inverted, self.figures.n_invalid)}"
