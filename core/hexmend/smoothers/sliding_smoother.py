"""Base of methods whose boundary nodes stay or slide on the surface (Wilson 5.2.1)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from hexmend.arrays import differing_rows, extent
from hexmend.boundary import SlidingBoundary
from hexmend.boundary.feature_edges.features import FEATURE_ANGLE
from hexmend.mesh.mesh import Mesh
from hexmend.parameters import AUTO, parameter
from hexmend.smoothers.base import Smoother

T = TypeVar("T")

#: Surface tolerance in mean edge lengths that auto begins with.
AUTO_TOLERANCE = 0.3

#: Surface tolerance without a limit: nodes slide, wherever the boundary between them goes.
UNLIMITED = "unlimited"

#: Sweeps in which a node would leave the band around the surface before it stays for good.
PATIENCE = 3


@dataclass(frozen=True)
class SlidingSmoother(Smoother):
    """Method that may let the nodes of the boundary slide on the surface."""

    feature_angle: float = parameter(
        FEATURE_ANGLE,
        low=1,
        high=180,
        unit="degrees",
        help="Edges with a larger dihedral angle are features; auto: chains of edges that are sharper than the "
        "curvature of the surface around them.",
        automatic=AUTO,
        advanced=True,
    )
    boundary: str = parameter(
        "fixed", choices=("fixed", "slide"), help="Keep boundary nodes fixed, or let them slide on the surface (5.2.1)."
    )
    surface_tolerance: float = parameter(
        AUTO,
        low=0,
        high=10,
        unit="mean edge length",
        help="Largest distance between boundary and surface: with 0 nodes slide only where the surface is flat; "
        "auto: 0.3; in mend 0.07, or up to 20 times that if untangling needs it.",
        no_limit=UNLIMITED,
        automatic=AUTO,
        percent_of="diagonal",
        advanced=True,
    )

    @property
    def slides(self) -> bool:
        return self.boundary == "slide"

    def slides_on(self, mesh: Mesh) -> bool:
        return self.slides or mesh.slides_by_rule

    def movable(self, mesh: Mesh) -> np.ndarray:
        sliding = self.sliding(mesh)
        return mesh.free if sliding is None else sliding.mesh.free

    def sliding(self, mesh: Mesh) -> SlidingBoundary | None:
        """The surface on which nodes of the boundary and of interfaces slide; None where they stay."""
        if not self.slides_on(mesh):
            return None
        return SlidingBoundary(mesh, self.feature_angle, self.absolute_tolerance(mesh), self.slides)

    def absolute_tolerance(self, mesh: Mesh) -> float:
        """Distance from the surface that the boundary may have, in the mesh's unit of length."""
        return absolute_tolerance(mesh, self.surface_tolerance)


def absolute_tolerance(mesh: Mesh, tolerance: float | str) -> float:
    """Convert a surface tolerance to the mesh's unit of length.

    Parameters
    ----------
    mesh : Mesh
    tolerance : float or str
        In mean edge lengths, in per cent of the boundary's diagonal such as "0.5%", "auto" or "unlimited".

    Returns
    -------
    float
    """
    if tolerance == UNLIMITED:
        return np.inf
    if isinstance(tolerance, str) and tolerance.endswith("%"):
        boundary = mesh.surface_points[mesh.topology.boundary]
        return float(tolerance[:-1]) / 100 * (float(np.linalg.norm(extent(boundary))) if boundary.size else 0.0)
    return (AUTO_TOLERANCE if tolerance == AUTO else float(tolerance)) * mesh.mean_edge_length


def moving(nodes: np.ndarray, stays: np.ndarray) -> np.ndarray:
    """Return the nodes (k,) that do not have to stay, stays (n,) bool; the same array if none of all nodes has to."""
    return nodes[~stays[nodes]] if stays.any() else nodes


class Sweeps:
    """Sweeps that move node after node and keep the boundary in the band around the surface.

    A sweep that leaves the band is repeated without the nodes at which it did. A node that had to stay in `PATIENCE`
    sweeps stays for good.

    Parameters
    ----------
    sliding : SlidingBoundary or None
        None where the boundary is fixed.
    n : int
        Number of nodes.
    """

    def __init__(self, sliding: SlidingBoundary | None, n: int):
        self.sliding, self._rejections = sliding, np.zeros(n, dtype=np.int64)

    def __call__(self, points: np.ndarray, sweep: Callable[[np.ndarray, np.ndarray], T]) -> tuple[np.ndarray, T]:
        """Sweep, and repeat it while it leaves the band.

        Parameters
        ----------
        points : (n, 3) float64
            Not changed.
        sweep : callable
            Takes points (n, 3), which it changes, and the nodes that have to stay, (n,) bool.

        Returns
        -------
        points : (n, 3) float64
        answer : object
            The returned value of the sweep.
        """
        stays = self._rejections >= PATIENCE
        while True:
            moved = points.copy()
            answer = sweep(moved, stays)
            beyond = np.empty(0, dtype=np.int64) if self.sliding is None else self.sliding.nodes_outside_band(moved)
            beyond = beyond[differing_rows(moved[beyond], points[beyond])]
            if not beyond.size:
                return moved, answer
            stays = stays.copy()
            stays[beyond] = True
            self._rejections[beyond] += 1
