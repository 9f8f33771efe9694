"""The surface of a mesh: corners, curves and patches of its boundary, closest points, and how two boundaries differ."""

from hexmend.surface.bends import sliding_boundary
from hexmend.surface.boundary import Boundary, Kind, boundary_of, classify
from hexmend.surface.change import Skin, SurfaceChange, distances, surface_change
from hexmend.surface.locked import freed_by_sliding
from hexmend.surface.room import Off
from hexmend.surface.sliding import Sliding
from hexmend.surface.surface import Surface
from hexmend.surface.trees import Closest, Trees

__all__ = [
    "Boundary",
    "Closest",
    "Kind",
    "Off",
    "Skin",
    "Sliding",
    "Surface",
    "SurfaceChange",
    "Trees",
    "boundary_of",
    "classify",
    "distances",
    "freed_by_sliding",
    "sliding_boundary",
    "surface_change",
]
