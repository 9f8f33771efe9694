"""Geometry of faces and cells as finite-volume solvers see it, with the definitions of OpenFOAM."""

from hexmend.quality.finite_volume.face_quality import FaceQuality, face_quality, worst_of_hexes
from hexmend.quality.finite_volume.geometry import CellGeometry, cell_geometry

__all__ = ["CellGeometry", "FaceQuality", "cell_geometry", "face_quality", "worst_of_hexes"]
