"""The surface of a mesh: corners, curves and patches of its boundary, closest points, and how two boundaries differ."""

from hexmend.surface.boundary import Boundary, Kind, boundary_of, classify
from hexmend.surface.surface import Closest, Surface

__all__ = ["Boundary", "Closest", "Kind", "Surface", "boundary_of", "classify"]
