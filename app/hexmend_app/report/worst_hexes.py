"""Table of the worst hexes of a mesh, with the reasons why some are locked."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.boundary import freed_by_sliding
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.solid_cells import SOLID_KINDS, centres, corner_tetrahedra, has_corner, kinds_of, nouns
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
    nouns : (str, str)
        Words for a cell of the mesh and for several.
    """

    locked: np.ndarray
    freed: np.ndarray
    nouns: tuple[str, str]

    @classmethod
    def of(cls, mesh: Mesh, quality: ElementQuality) -> Locked:
        """Find the locked hexes."""
        mask = locked_hexes(mesh.points, mesh.elements, mesh.fixed, quality.inverted)
        return cls(mask, freed_by_sliding(mesh, mask), nouns(mesh.elements))

    def words(self) -> str:
        """Return sentences on the number of locked hexes; "" for none."""
        count, freed = int(self.locked.sum()), int(self.freed.sum())
        if not count:
            return ""
        noun = f"{self.nouns[0]} is" if count == 1 else f"{self.nouns[1]} are"
        return (
            f"{format_count(count)} inverted {noun} locked: all four nodes of a corner with σ ≤ 0 are fixed. "
            f"Sliding the boundary (--boundary slide) can free {format_count(freed)} of them; "
            f"{format_count(count - freed)} cannot be freed."
        )


def worst_table(name: str, mesh: Mesh, quality: ElementQuality, locked: Locked) -> Table:
    """Return a table of the worst hexes by q: number (from 0), q, scaled Jacobian, centre in mesh units, and state."""
    order = rank_worst(quality.q, quality, MAX_WORST_HEXES)
    places, kinds = centres(mesh.points, mesh.elements[order]), kinds_of(mesh.elements[order])
    rows = [
        [
            f"{format_count(int(hex))} ({SOLID_KINDS[kind].name})" if kind else format_count(int(hex)),
            format_quality(quality.q[hex]),
            format_quality(quality.scaled_jacobian[hex]),
            ", ".join(f"{part:.5g}" for part in place),
            reason(mesh, quality, locked, int(hex)),
        ]
        for hex, place, kind in zip(order, places, kinds, strict=True)
    ]
    noun, several = locked.nouns
    return Table(f"The worst {several}: {name}", [noun, "q", "scaled Jacobian", "centre", "state"], rows)


def reason(mesh: Mesh, quality: ElementQuality, locked: Locked, hex: int) -> str:
    """Return the state of a hex (locked, inverted, invalid inside or valid) and its number of free nodes."""
    if locked.locked[hex]:
        return (
            f"locked {_corners(mesh, hex)}; {'sliding frees it' if locked.freed[hex] else 'sliding does not free it'}"
        )
    nodes = np.unique(mesh.elements[hex])
    free = int(mesh.free[nodes].sum())
    inverted, invalid = quality.inverted[hex], quality.invalid[hex]
    state = "inverted, not locked" if inverted else "invalid inside" if invalid else "valid"
    return f"{state}, {f'{free} of {len(nodes)} nodes free' if free else f'all {len(nodes)} nodes fixed'}"


def _corners(mesh: Mesh, hex: int) -> str:
    """Return a phrase with the nodes at the inverted corners whose nodes are all fixed."""
    row = mesh.elements[[hex]]
    sigma = corner_determinants(mesh.points, row)[0]
    corners = np.flatnonzero(mesh.fixed[corner_tetrahedra(row)[0]].all(axis=1) & has_corner(row)[0] & ~(sigma > 0))
    nodes = ", ".join(str(int(mesh.elements[hex][corner])) for corner in corners)
    noun = "at node" if corners.size == 1 else "at nodes"
    return f"{noun} {nodes} by fixed nodes, σ = {sigma[corners].min():.3g}"
