"""Nodes that slide on the surface of a boundary: on which curves and patches, in which directions, and how far."""

from hexmend.boundary.sliding.sliding_boundary import SlidingBoundary
from hexmend.boundary.sliding.sliding_nodes import SlidingNodes

__all__ = ["SlidingBoundary", "SlidingNodes"]
