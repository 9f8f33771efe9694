"""Summary of the Jacobians of second-order hexes, which their eight corners do not determine."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass

import numpy as np

from hexmend.mesh.mesh import Mesh
from hexmend.quality.validity import Validity, certify, least_jacobian
from hexmend.quantity import format_count, format_quality


@dataclass(frozen=True)
class SecondOrderSummary:
    """Summary of the hexes of 20 or 27 nodes of a mesh.

    Parameters
    ----------
    hexes : int
        Number of these hexes.
    invalid : int
        Number of hexes whose det J is not certified as positive everywhere.
    min_jacobian : float
        Certified lower bound of the least det J in a hex over the greatest in the same hex.
    """

    hexes: int
    invalid: int
    min_jacobian: float

    def to_dict(self) -> dict[str, float | int]:
        """Return the values by name."""
        return dataclasses.asdict(self)

    @property
    def phrase(self) -> str:
        """Description of the values as part of a sentence."""
        return (
            f"{format_count(self.invalid)} of {format_count(self.hexes)} are invalid (least Jacobian over the greatest "
            f"in a hex: {format_quality(self.min_jacobian)})"
        )


def summarise_second_order(mesh: Mesh) -> SecondOrderSummary | None:
    """Summarise the second-order hexes of a mesh; None if it has none."""
    if mesh.mid_nodes is None:
        return None
    which = (mesh.mid_nodes >= 0).any(axis=1)
    if not which.any():
        return None
    hexes, mid_nodes = np.ascontiguousarray(mesh.hexes[which]), mesh.mid_nodes[which]
    invalid = int(np.count_nonzero(certify(mesh.points, hexes, mid_nodes) != Validity.VALID))
    return SecondOrderSummary(len(hexes), invalid, least_jacobian(mesh.points, hexes, mid_nodes))
