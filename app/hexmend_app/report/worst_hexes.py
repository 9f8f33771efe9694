"""Table of the worst hexes of a mesh, with the reasons why some are locked."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.boundary import freed_by_sliding
from hexmend.mesh.hexahedron import CORNER_TETRAHEDRA
from hexmend.mesh.mesh import Mesh
from hexmend.quality import ElementQuality, corner_determinants, locked_hexes, rank_worst
from hexmend.quantity import format_count, format_quality
from hexmend.report.tables import Table

#: Number of hexes in the table.
MAX_WORST_HEXES = 12


@dataclass(frozen=True, eq=False)
class Locked:
    """Hexes that are inverted because of fixed nodes alone.

    Parameters
    ----------
    locked : (m,) bool
    freed : (m,) bool
        Locked hexes that can be repaired if the boundary slides.
    """

    locked: np.ndarray
    freed: np.ndarray

    @classmethod
    def of(cls, mesh: Mesh, quality: ElementQuality) -> Locked:
        """Find the locked hexes."""
        mask = locked_hexes(mesh.points, mesh.hexes, mesh.fixed, quality.inverted)
        return cls(mask, freed_by_sliding(mesh, mask))

    def words(self) -> str:
        """Return sentences on the number of locked hexes; "" for none."""
        count, freed = int(self.locked.sum()), int(self.freed.sum())
        if not count:
            return ""
        rest = count - freed
        noun = "hex is" if count == 1 else "hexes are"
        return (
            f"{format_count(count)} inverted {noun} locked: all four nodes of a corner with σ ≤ 0 are fixed. "
            f"Sliding the boundary (--boundary slide) can free {format_count(freed)} of them; "
            f"{format_count(rest)} cannot be freed."
        )


def worst_table(name: str, mesh: Mesh, quality: ElementQuality, locked: Locked) -> Table:
    """Return a table of the worst hexes by q: number (from 0), q, scaled Jacobian, centre in mesh units, and state."""
    order = rank_worst(quality.q, quality, MAX_WORST_HEXES)
    rows = [
        [
            format_count(int(hex)),
            format_quality(quality.q[hex]),
            format_quality(quality.scaled_jacobian[hex]),
            ", ".join(f"{part:.5g}" for part in mesh.points[mesh.hexes[hex]].mean(axis=0)),
            reason(mesh, quality, locked, int(hex)),
        ]
        for hex in order
    ]
    return Table(f"The worst hexes: {name}", ["hex", "q", "scaled Jacobian", "centre", "state"], rows)


def reason(mesh: Mesh, quality: ElementQuality, locked: Locked, hex: int) -> str:
    """Return the state of a hex (locked, inverted, invalid inside or valid) and its number of free nodes."""
    if locked.locked[hex]:
        return (
            f"locked {_corners(mesh, hex)}; {'sliding frees it' if locked.freed[hex] else 'sliding does not free it'}"
        )
    free = int(mesh.free[mesh.hexes[hex]].sum())
    inverted, invalid = quality.inverted[hex], quality.invalid[hex]
    state = "inverted, not locked" if inverted else "invalid inside" if invalid else "valid"
    return f"{state}, {f'{free} of 8 nodes free' if free else 'all 8 nodes fixed'}"


def _corners(mesh: Mesh, hex: int) -> str:
    """Return a phrase with the nodes at the inverted corners whose nodes are all fixed."""
    tetrahedra = mesh.hexes[hex][CORNER_TETRAHEDRA]  # (8, 4)
    sigma = corner_determinants(mesh.points, mesh.hexes, np.array([hex]))[0]
    corners = np.flatnonzero(mesh.fixed[tetrahedra].all(axis=1) & ~(sigma > 0))
    nodes = ", ".join(str(int(mesh.hexes[hex][corner])) for corner in corners)
    noun = "at node" if corners.size == 1 else "at nodes"
    return f"{noun} {nodes} by fixed nodes, σ = {sigma[corners].min():.3g}"
