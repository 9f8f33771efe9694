"""What a quality metric declares of itself, and the registry of them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from hexmend.mesh.validation import as_hexes, as_points
from hexmend.quality.measure import ElementQuality
from hexmend.registry import Registry, load_entry_points

#: Values (m,) from points (n, 3), hexes (m, 8) and the figures measured of them.
Values = Callable[[np.ndarray, np.ndarray, ElementQuality], np.ndarray]


@dataclass(frozen=True)
class HexQuantity:
    """What is declared of a figure that every hex has.

    Parameters
    ----------
    name, title, formula, source : str
        The title is short enough for a colour bar.
    full_range : (low, high)
        Values that it can take; a hex for which the formula has no value has the worse end of it.
    acceptable : (low, high)
        Values that solvers are usually content with.
    better : int
        1 where higher values are better, -1 where lower ones are, 0 where neither is.
    meaning : str
        What a bad value means for a solver, in a sentence.
    unit : str
        "" for a mere number.
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
        """True for each of values (m,) worse than the acceptable range, or outside it where neither way is better."""
        low, high = self.acceptable
        return ~(values >= low) & (self.better >= 0) | ~(values <= high) & (self.better <= 0)


@dataclass(frozen=True, kw_only=True)
class Metric(HexQuantity):
    """A figure of every hex of one mesh.

    Parameters
    ----------
    of : callable
        Gives the values, (m,) float64, from `points` (n, 3), `hexes` (m, 8) and the `ElementQuality` measured of them.
        None is NaN if the points are finite.
    """

    of: Values


def kernel_metric(kernel: Callable[..., None], rows: int, row: int, worst: float) -> Values:
    """Values by a kernel that writes several figures in one pass.

    Parameters
    ----------
    kernel : callable
        One of `hexmend.kernels`; it takes points, hexes and so many arrays (m,) as it writes.
    rows, row : int
        How many these are, and which of them is meant.
    worst : float
        Stands for what is no number: of a hex so large that the squares of its lengths overflow.
    """

    def of(points: np.ndarray, hexes: np.ndarray, figures: ElementQuality) -> np.ndarray:
        points = as_points(points)
        hexes = as_hexes(hexes, len(points))
        values = np.empty((rows, len(hexes)))
        kernel(points, hexes, *values)
        values[row][np.isnan(values[row])] = worst
        return values[row]

    return of


#: The entry-point group through which other distributions add theirs: entries name a `Metric`.
GROUP = "hexmend.metrics"


def load_plugins() -> None:
    """Load the metrics of other distributions."""
    load_entry_points(GROUP, "metric", _take)


def _take(name: str, metric: object) -> None:
    if not isinstance(metric, Metric):
        raise TypeError(f"{metric!r} is no hexmend.quality.Metric")
    if metric not in METRICS.values():  # its module may have registered it
        METRICS.add(metric.name, metric)


METRICS: Registry[Metric] = Registry("metric", load_plugins)
