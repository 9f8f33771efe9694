"""The surface of a mesh: corners, curves and patches of its boundary, closest points, and how two boundaries differ."""

from hexmend.boundary.band import Off
from hexmend.boundary.classification import Boundary, Kind, boundary_of, classify
from hexmend.boundary.closest_point import Closest, Trees
from hexmend.boundary.comparison import Skin, SurfaceChange, distances, surface_change
from hexmend.boundary.corner_detection import sliding_boundary
from hexmend.boundary.sliding import Sliding
from hexmend.boundary.surface import Surface
from hexmend.boundary.unlocking import freed_by_sliding

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
