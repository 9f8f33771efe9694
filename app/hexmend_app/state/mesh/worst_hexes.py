"""The worst hexes of a mesh."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hexmend.mesh.mesh import Mesh
from hexmend.quality import METRICS, ElementQuality, locked_hexes, rank_worst
from hexmend.quality.file_ids import hex_ids
from hexmend_app.state.mesh.metric_cache import metric_values

#: Maximum number of hexes in the list, which is rebuilt at every iteration.
MAX_LISTED = 1000


@dataclass(frozen=True, eq=False)
class WorstHexes:
    """The worst hexes by a metric, worst first.

    Parameters
    ----------
    hexes : (k,) int64
        Numbers of the hexes.
    values, jacobians : (k,) float64
        Values of the metric, and scaled Jacobians.
    states : list of str
        "locked" if fixed nodes alone keep the hex inverted, "inverted" for other inverted hexes, "inside" for hexes
        that are invalid inside, else "".
    ids : (k,) int, optional
        Numbers of the hexes in the file; None if that counts from 0 too, or has none.
    """

    hexes: np.ndarray
    values: np.ndarray
    jacobians: np.ndarray
    states: list[str]
    ids: np.ndarray | None = None

    @classmethod
    def of(cls, mesh: Mesh, quality: ElementQuality, metric: str) -> WorstHexes:
        """Find the worst hexes of a mesh by the metric with this name in `METRICS`."""
        values = metric_values(metric, mesh, quality)
        worst = rank_worst(values, quality, min(MAX_LISTED, values.size), METRICS[metric].better or 1)
        inverted = quality.inverted[worst]
        locked = locked_hexes(mesh.points, mesh.hexes[worst], mesh.fixed, inverted)
        states = np.select([locked, inverted, quality.invalid[worst]], ["locked", "inverted", "inside"], "").tolist()
        ids = hex_ids(mesh)
        of_file = None if ids is None else ids[worst]
        return cls(worst, values[worst], quality.scaled_jacobian[worst], states, of_file)
