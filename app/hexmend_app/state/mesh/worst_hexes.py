"""The worst hexes of a mesh."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.mesh.mesh import Mesh
from hexmend.quality import METRICS, ElementQuality, locked_hexes, rank_worst
from hexmend_app.state.mesh.metric_cache import metric_values

#: Elements in the list at most: nobody reads more, and they are found anew at every iteration.
MOST = 1000


@dataclass(frozen=True, eq=False)
class Worst:
    """The worst hexes by a metric, the worst first.

    Parameters
    ----------
    elements : (k,) int64
    values, jacobians : (k,) float64
        Of the metric, and the scaled Jacobian.
    states : list of str
        "inverted", "locked" where fixed nodes alone hold it so, or "".
    """

    elements: np.ndarray
    values: np.ndarray
    jacobians: np.ndarray
    states: list[str]

    @classmethod
    def of(cls, mesh: Mesh, figures: ElementQuality, metric: str) -> Worst:
        """Find them."""
        known = metric_values(metric, mesh.points, mesh.hexes, figures)
        chosen = rank_worst(known, figures, min(MOST, known.size), METRICS[metric].better or 1)
        inverted = figures.inverted[chosen]
        locked = locked_hexes(mesh.points, mesh.hexes[chosen], mesh.fixed, inverted)
        states = ["locked" if h else "inverted" if i else "" for i, h in zip(inverted, locked, strict=True)]
        return cls(chosen, known[chosen], figures.scaled_jacobian[chosen], states)
