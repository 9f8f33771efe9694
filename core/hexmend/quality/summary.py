"""Measurement of the summary of a mesh, and of the objective that smoothing minimises.

Statistics of every metric over a mesh.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from hexmend.mesh.mesh import Mesh
from hexmend.mesh.solid_cells import rows_by_kind
from hexmend.quality.measure import ElementQuality, locked_hexes, measure
from hexmend.quality.metric import METRICS, Metric
from hexmend.quality.validity import least_jacobian
from hexmend.summary import SUMMARY_QUANTITIES, Summary

__all__ = ["SUMMARY_QUANTITIES", "Summary", "objective", "summarise"]


def summarise(mesh: Mesh, quality: ElementQuality | None = None) -> Summary:
    """Summarise the quality of a mesh.

    Parameters
    ----------
    mesh : Mesh
    quality : ElementQuality, optional
        Quality of the hexes, if it is measured already.

    Returns
    -------
    Summary

    Examples
    --------
    >>> from hexmend.mesh.hexahedron import UNIT_CUBE
    >>> summarise(Mesh(UNIT_CUBE, [range(8)])).q_norm
    1.0
    """
    quality = quality or measure(mesh.points, mesh.elements, mesh.mid_nodes)
    mesh._set(_invalid=quality.n_invalid)  # for its representation
    q = quality.q
    return Summary(
        hexes=mesh.n_hexes,
        nodes=int(np.count_nonzero(mesh.topology.used)),
        free_nodes=int(np.count_nonzero(mesh.free)),
        inverted=quality.n_inverted,
        locked_inverted=int(np.count_nonzero(locked_hexes(mesh.points, mesh.elements, mesh.fixed, quality.inverted))),
        invalid=quality.n_invalid,
        min_jacobian=least_jacobian(mesh.points, mesh.elements, mesh.mid_nodes),
        q_min=float(q.min()),
        q_mean=float(q.mean()),
        q_max=float(q.max()),
        q_std=float(q.std()),
        q_norm=float(1 / np.sqrt(np.mean(1 / np.square(q)))) if q.min() > 0 else 0.0,
        scaled_jacobian_min=float(quality.scaled_jacobian.min()),
        objective=objective(quality),
        cells=dict(_by_kind(mesh, quality)),
    )


def _by_kind(mesh: Mesh, quality: ElementQuality) -> Iterator[tuple[str, dict[str, float | int]]]:
    """Yield the name of each kind of cells that the mesh has, and the figures of its cells."""
    for kind, rows in rows_by_kind(mesh.elements):
        q, jacobian = quality.q[rows], quality.scaled_jacobian[rows]
        yield (
            kind.name,
            {
                "count": len(q),
                "inverted": int(np.count_nonzero(quality.inverted[rows])),
                "invalid": int(np.count_nonzero(quality.invalid[rows])),
                "q_min": float(q.min()),
                "q_mean": float(q.mean()),
                "scaled_jacobian_min": float(jacobian.min()),
            },
        )


def objective(quality: ElementQuality, p: float = 2.0, offset: float = 1.0) -> float | None:
    """Compute the objective of a mesh at delta = 0: the sum of eta(H)^p, the p-th power of (3.3).

    Parameters
    ----------
    quality : ElementQuality
    p, offset : float
        Exponent and offset of `hexmend.energy.ObjectiveNorm`; the defaults are those of `Summary.objective`.

    Returns
    -------
    float or None
        None if any hex is inverted or the sum overflows.

    Examples
    --------
    >>> from hexmend.mesh.hexahedron import UNIT_CUBE
    >>> quality = measure(UNIT_CUBE, np.arange(8, dtype=np.int32)[None])
    >>> objective(quality), objective(quality, p=4.0, offset=0.0)
    (0.0, 1.0)
    """
    if quality.n_inverted:
        return None
    with np.errstate(over="ignore"):
        total = float(((quality.eta + (1 - offset)) ** p).sum())
    return total if np.isfinite(total) else None


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
        """Compute the statistics of a metric's values, (m,); NaN is no value."""
        values = values[~np.isnan(values)]
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
    quality = measure(mesh.points, mesh.elements, mesh.mid_nodes) if quality is None else quality
    return {name: MetricStatistics.over(metric, metric.values(mesh, quality)) for name, metric in METRICS.items()}
