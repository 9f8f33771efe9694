"""Meshes of a page."""

from __future__ import annotations

from dataclasses import dataclass

from hexmend.mesh.mesh import Mesh
from hexmend.quality import measure
from hexmend_app.scene.geometry.frame import Frame
from hexmend_app.state.mesh.hex_groups import invalid_counts


@dataclass(frozen=True, eq=False)
class PageMesh(Frame):
    """Mesh of a page with its quality, movement and name; of several meshes, the others use the data of the first.

    Parameters
    ----------
    name : str
        Name in the caption.
    """

    name: str = ""

    @classmethod
    def of(cls, mesh: Mesh, name: str = "") -> PageMesh:
        """Return a mesh with its measured quality, under its own name by default."""
        return cls(mesh, measure(mesh.points, mesh.elements, mesh.mid_nodes), name=name or mesh.name)

    @property
    def text(self) -> str:
        """Figures of the caption: smallest q and number of invalid hexes."""
        return f"q min {self.quality.q.min():.4f}, {invalid_counts(self.quality.n_inverted, self.quality.n_invalid)}"
