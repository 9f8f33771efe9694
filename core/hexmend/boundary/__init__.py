"""The surface of a mesh: corners, curves and patches of its boundary, closest points, and how two boundaries differ."""

from hexmend.aliases import exports
from hexmend.boundary.band import Deviations
from hexmend.boundary.classification import Boundary, NodeClass, boundary_of, classify
from hexmend.boundary.closest_point import ClosestPoints, ClosestPointTrees
from hexmend.boundary.comparison import SkinSurface, SurfaceChange, distances, surface_change
from hexmend.boundary.corner_detection import sliding_boundary
from hexmend.boundary.sliding import SlidingBoundary
from hexmend.boundary.surface import Surface
from hexmend.boundary.unlocking import freed_by_sliding

__all__ = [
    "Boundary",
    "ClosestPointTrees",
    "ClosestPoints",
    "Deviations",
    "NodeClass",
    "SkinSurface",
    "SlidingBoundary",
    "Surface",
    "SurfaceChange",
    "boundary_of",
    "classify",
    "distances",
    "freed_by_sliding",
    "sliding_boundary",
    "surface_change",
]

__getattr__ = exports(__name__)
