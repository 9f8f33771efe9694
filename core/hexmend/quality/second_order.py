"""The Jacobian of hexes of second order, which a solver computes where their eight corners alone say nothing."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass

import numpy as np

from hexmend.mesh.mesh import Mesh
from hexmend.mesh.second_order import scaled_jacobians
from hexmend.quantity import format_count, format_quality


@dataclass(frozen=True)
class SecondOrderSummary:
    """Hexes of 20 or 27 nodes in a mesh.

    Parameters
    ----------
    hexes : int
    non_positive : int
        How many have a Jacobian of 0 or less at one of their nodes or of the 3 x 3 x 3 Gauss points.
    scaled_jacobian_min : float
        The least over all of them, by the lengths of its columns.
    """

    hexes: int
    non_positive: int
    scaled_jacobian_min: float

    def to_dict(self) -> dict[str, float | int]:
        """Figures by name."""
        return dataclasses.asdict(self)

    @property
    def phrase(self) -> str:
        """Description of the values as part of a sentence."""
        return (
            f"{format_count(self.non_positive)} of {format_count(self.hexes)} have a Jacobian that is not positive at "
            f"their nodes or Gauss points (least, scaled: {format_quality(self.scaled_jacobian_min)})"
        )


def summarise_second_order(mesh: Mesh) -> SecondOrderSummary | None:
    """The hexes of second order of a mesh; None where there are none."""
    if mesh.mid_nodes is None:
        return None
    least = scaled_jacobians(mesh.points, mesh.hexes, mesh.mid_nodes)
    least = least[~np.isnan(least)]
    return SecondOrderSummary(len(least), int(np.count_nonzero(least <= 0)), float(least.min())) if len(least) else None
