"""Locked hexes: those that no movement of nodes can mend while the boundary stays as it is, with proofs."""

from hexmend.locking.locked_corners import Reason
from hexmend.locking.locking import (
    Locking,
    describe_overlap,
    find_locking,
    hexes_without_valid_position,
    nodes_without_valid_position,
)

__all__ = [
    "Locking",
    "Reason",
    "describe_overlap",
    "find_locking",
    "hexes_without_valid_position",
    "nodes_without_valid_position",
]
