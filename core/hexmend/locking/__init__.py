"""Locked hexes: those that no movement of nodes can mend while the boundary stays as it is, with proofs."""

from hexmend.locking.locked_corners import LockedCorner, Reason, find_locked_corners
from hexmend.locking.locking import Locking, find_locking
from hexmend.locking.overlapping_corners import (
    describe_overlap,
    hexes_without_valid_position,
    nodes_without_valid_position,
)
from hexmend.locking.visibility import nodes_without_space

__all__ = [
    "LockedCorner",
    "Locking",
    "Reason",
    "describe_overlap",
    "find_locked_corners",
    "find_locking",
    "hexes_without_valid_position",
    "nodes_without_space",
    "nodes_without_valid_position",
]
