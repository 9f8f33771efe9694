"""Declaration of a quality metric, and the registry of metrics."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from hexmend.mesh.mesh import Mesh
from hexmend.quality.measure import ElementQuality
from hexmend.registry import Registry, load_entry_points

#: Function that computes values (m,) from points (n, 3), hexes (m, 8) and their measured quality.
Values = Callable[[np.ndarray, np.ndarray, ElementQuality], np.ndarray]

#: Function that computes values (m,) from a mesh and its measured quality.
MeshValues = Callable[[Mesh, ElementQuality], np.ndarray]


@dataclass(frozen=True)
class HexQuantity:
    """Declaration of a quantity that every hex has.

    Parameters
    ----------
    name, title, formula, source : str
        The title is short enough for a colour bar.
    full_range : (low, high)
        Possible values; a hex for which the formula has no value gets the worse end.
    acceptable : (low, high)
        Values that are usually good enough for solvers.
    better : int
        1 if higher values are better, -1 if lower ones are, 0 if neither.
    meaning : str
        Consequence of a bad value for a solver, as a sentence.
    unit : str
        "" for a dimensionless quantity.
    """

    name: str
    title: str
    formula: str
    source: str
    full_range: tuple[float, float]
    acceptable: tuple[float, float]
    better: int
    meaning: str
    unit: str = ""

    def unacceptable(self, values: np.ndarray) -> np.ndarray:
        """Return True for values (m,) worse than the acceptable range, or outside it if no end is better; (m,) bool."""
        low, high = self.acceptable
        return ~(values >= low) & (self.better >= 0) | ~(values <= high) & (self.better <= 0)


@dataclass(frozen=True, kw_only=True)
class Metric(HexQuantity):
    """Quality metric of hexes.

    Parameters
    ----------
    of : callable
        Computes the values, (m,) float64, from `points` (n, 3), `hexes` (m, 8) and their `ElementQuality`. For finite
        points no value is NaN. The value of a hex may depend on its neighbours among these hexes.
    of_mesh : callable, optional
        Computes the values from a mesh and its `ElementQuality`, for a metric that needs more of the mesh than points
        and hexes; `of` then gives the values of a mesh that has nothing else.
    """

    of: Values
    of_mesh: MeshValues | None = None

    def values(self, mesh: Mesh, quality: ElementQuality) -> np.ndarray:
        """Compute the values of the hexes of a mesh, (m,) float64, from the mesh and its measured quality."""
        if self.of_mesh is not None:
            return self.of_mesh(mesh, quality)
        return self.of(mesh.points, mesh.elements, quality)

    def register(self) -> Metric:
        """Add the metric to `METRICS` under its name and return it; raises `ValueError` if the name is taken."""
        return METRICS.add(self.name, self)


#: Entry-point group through which other distributions add metrics; an entry names a `Metric`.
GROUP = "hexmend.metrics"


def load_plugins() -> None:
    """Load the metrics of other distributions."""
    load_entry_points(GROUP, "metric", _take)


def _take(name: str, metric: object) -> None:
    if not isinstance(metric, Metric):
        raise TypeError(f"{metric!r} is not a hexmend.quality.Metric")
    if metric not in METRICS.values():  # its module may have registered it
        metric.register()


METRICS: Registry[Metric] = Registry("metric", load_plugins)
"""Metrics by name; those of other distributions are loaded when all names are asked for."""
