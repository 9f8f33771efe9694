"""Volumes of the materials of a mesh."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.kernels import faces
from hexmend.mesh.mesh import Mesh


@dataclass(frozen=True)
class MaterialVolume:
    """Volume of a material before and after a run, in cubes of the mesh's unit."""

    before: float
    after: float

    @property
    def change(self) -> float:
        """Relative change; 0 for a material without volume."""
        return (self.after - self.before) / self.before if self.before else 0.0

    def to_dict(self) -> dict[str, float]:
        """Return the volumes by name."""
        return {"volume_before": self.before, "volume_after": self.after}


def material_volumes(mesh: Mesh) -> dict[str, float]:
    """Return the volume of each material of a mesh by name, inside the bilinear faces of its hexes.

    Empty for a mesh of one material.

    Examples
    --------
    >>> from hexmend.gallery import make
    >>> cube = make("cube", size=8).replace(hex_sets={"low": np.arange(4), "high": np.arange(4, 8)})
    >>> material_volumes(cube)
    {'low': 0.5, 'high': 0.5}
    """
    materials = mesh.materials
    if materials is None:
        return {}
    volumes = np.empty(mesh.n_elements)
    faces.volume(mesh.points, mesh.elements, volumes)
    sums = np.bincount(materials.of_hex, np.where(np.isfinite(volumes), volumes, 0.0), minlength=len(materials))
    return dict(zip(materials.names, sums.tolist(), strict=True))


def volume_changes(before: Mesh, after: Mesh) -> dict[str, MaterialVolume]:
    """Return the volumes of each material of a mesh before and after its nodes moved, by name."""
    then, now = material_volumes(before), material_volumes(after)
    return {name: MaterialVolume(volume, now[name]) for name, volume in then.items()}
