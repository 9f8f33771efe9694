"""Summary of the Jacobians of second-order hexes, which their eight corners do not determine."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass

import numpy as np

from hexmend.mesh.mesh import Mesh
from hexmend.mesh.second_order import scaled_jacobians
from hexmend.quantity import format_count, format_quality


@dataclass(frozen=True)
class SecondOrderSummary:
    """Summary of the hexes of 20 or 27 nodes of a mesh.

    Parameters
    ----------
    hexes : int
        Number of these hexes.
    non_positive : int
        Number of hexes with a Jacobian of 0 or less at a node or a point of the 3 x 3 x 3 Gauss rule.
    scaled_jacobian_min : float
        Minimum scaled Jacobian of all.
    """

    hexes: int
    non_positive: int
    scaled_jacobian_min: float

    def to_dict(self) -> dict[str, float | int]:
        """Return the values by name."""
        return dataclasses.asdict(self)

    @property
    def phrase(self) -> str:
        """Description of the values as part of a sentence."""
        return (
            f"{format_count(self.non_positive)} of {format_count(self.hexes)} have a Jacobian that is not positive at "
            f"their nodes or Gauss points (least, scaled: {format_quality(self.scaled_jacobian_min)})"
        )


def summarise_second_order(mesh: Mesh) -> SecondOrderSummary | None:
    """Summarise the second-order hexes of a mesh; None if it has none."""
    if mesh.mid_nodes is None:
        return None
    least = scaled_jacobians(mesh.points, mesh.hexes, mesh.mid_nodes)
    least = least[~np.isnan(least)]
    return SecondOrderSummary(len(least), int(np.count_nonzero(least <= 0)), float(least.min())) if len(least) else None
