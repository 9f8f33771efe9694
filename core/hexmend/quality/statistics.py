"""Statistics of every metric over a mesh."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass

import numpy as np

from hexmend.mesh.mesh import Mesh
from hexmend.quality.measure import ElementQuality, measure
from hexmend.quality.metric import METRICS, Metric


@dataclass(frozen=True)
class MetricStatistics:
    """Statistics of one metric over the hexes of a mesh.

    Parameters
    ----------
    min, mean, max : float or None
        Of the finite values; None if there are none.
    infinite : int
        Number of hexes whose value is not finite, such as the edge ratio with an edge of length 0.
    unacceptable : int
        Number of hexes, infinite values included, worse than the metric's acceptable range.
    """

    min: float | None
    mean: float | None
    max: float | None
    infinite: int
    unacceptable: int

    @classmethod
    def over(cls, metric: Metric, values: np.ndarray) -> MetricStatistics:
        """Compute the statistics of a metric's values, (m,)."""
        finite = values[np.isfinite(values)]
        low, mean, high = (float(of()) for of in (finite.min, finite.mean, finite.max)) if finite.size else [None] * 3
        unacceptable = int(np.count_nonzero(metric.unacceptable(values)))
        return cls(low, mean, high, values.size - finite.size, unacceptable)

    def to_dict(self) -> dict[str, float | int | None]:
        """Return the values by name."""
        return dataclasses.asdict(self)


def metric_statistics(mesh: Mesh, quality: ElementQuality | None = None) -> dict[str, MetricStatistics]:
    """Compute the statistics of every metric, by its name.

    Parameters
    ----------
    mesh : Mesh
    quality : ElementQuality, optional
        Quality of the hexes, if it is measured already.

    Returns
    -------
    dict of str to MetricStatistics

    Examples
    --------
    >>> from hexmend.mesh.hexahedron import UNIT_CUBE
    >>> metric_statistics(Mesh(UNIT_CUBE, [range(8)]))["max-angle"]
    MetricStatistics(min=90.0, mean=90.0, max=90.0, infinite=0, unacceptable=0)
    """
    quality = measure(mesh.points, mesh.hexes, mesh.mid_nodes) if quality is None else quality
    return {name: MetricStatistics.over(metric, metric.values(mesh, quality)) for name, metric in METRICS.items()}
