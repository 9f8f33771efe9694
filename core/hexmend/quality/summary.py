"""The figures of a whole mesh."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass

import numpy as np

from hexmend.mesh import Mesh
from hexmend.quality.measure import ElementQuality, locked, measure


@dataclass(frozen=True)
class Summary:
    """Figures of a mesh, (2.11), (2.12) and what stands beside them.

    `nodes` counts nodes that a hex uses; `locked_inverted` the inverted hexes that fixed nodes alone hold in inversion;
    `q_norm` is 1/sqrt(mean(1/q^2)), 0 if any q is 0; `objective` the sum of eta(H)^2 at delta = 0, None while any hex
    is inverted.
    """

    hexes: int
    nodes: int
    free_nodes: int
    inverted: int
    locked_inverted: int
    q_min: float
    q_mean: float
    q_max: float
    q_std: float
    q_norm: float
    scaled_jacobian_min: float
    objective: float | None

    def to_dict(self) -> dict[str, float | int | None]:
        """Figures by name."""
        return dataclasses.asdict(self)


def summarise(mesh: Mesh, figures: ElementQuality | None = None) -> Summary:
    """Summarise a mesh; pass `figures` where they are measured already.

    Examples
    --------
    >>> from hexmend.hexahedron import UNIT_CUBE
    >>> summarise(Mesh(UNIT_CUBE, [range(8)])).q_norm
    1.0
    """
    figures = measure(mesh.points, mesh.hexes) if figures is None else figures
    q = figures.q
    return Summary(
        hexes=mesh.n_hexes,
        nodes=int(np.count_nonzero(mesh.topology.used)),
        free_nodes=int(np.count_nonzero(mesh.free)),
        inverted=figures.n_inverted,
        locked_inverted=int(np.count_nonzero(locked(mesh.points, mesh.hexes, mesh.fixed, figures.inverted))),
        q_min=float(q.min()),
        q_mean=float(q.mean()),
        q_max=float(q.max()),
        q_std=float(q.std()),
        q_norm=float(1 / np.sqrt(np.mean(1 / np.square(q)))) if q.min() > 0 else 0.0,
        scaled_jacobian_min=float(figures.scaled_jacobian.min()),
        objective=objective(figures),
    )


def objective(figures: ElementQuality) -> float | None:
    """Sum of eta(H)^2 at delta = 0, the square of (3.3) with p = 2; None while any hex is inverted."""
    return float(np.square(figures.eta).sum()) if figures.n_inverted == 0 else None
