"""Boundary of a mesh: corners, curves and patches, sliding on a surface, closest points, comparison of two surfaces."""

from hexmend.boundary.classification import Boundary, NodeClass, boundary_of, classify
from hexmend.boundary.closest_point import ClosestPoints, ClosestPointTrees
from hexmend.boundary.comparison import Departures, Keeping, SurfaceChange, departures, mutual_distances, surface_change
from hexmend.boundary.feature_edges.corner_detection import boundary_with_kept_corners
from hexmend.boundary.skin_surface import SkinSurface
from hexmend.boundary.sliding import SlidingBoundary
from hexmend.boundary.sliding.sliding_boundary import freed_by_sliding
from hexmend.boundary.surface import PartitionedSurface

__all__ = [
    "Boundary",
    "ClosestPointTrees",
    "ClosestPoints",
    "Departures",
    "Keeping",
    "NodeClass",
    "PartitionedSurface",
    "SkinSurface",
    "SlidingBoundary",
    "SurfaceChange",
    "boundary_of",
    "boundary_with_kept_corners",
    "classify",
    "departures",
    "freed_by_sliding",
    "mutual_distances",
    "surface_change",
]
