"""What a quality metric declares of itself, and the registry of them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from hexmend.registry import Registry

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy as np

    from hexmend.quality.measure import ElementQuality


@dataclass(frozen=True)
class Metric:
    """A figure of every hex.

    Parameters
    ----------
    name, title, formula, source : str
    full_range : (low, high)
        Values that it can take.
    acceptable : (low, high)
        Values that solvers are usually content with.
    of : callable
        Picks the (m,) values from an `ElementQuality`.
    """

    name: str
    title: str
    formula: str
    source: str
    full_range: tuple[float, float]
    acceptable: tuple[float, float]
    of: Callable[[ElementQuality], np.ndarray]


METRICS: Registry[Metric] = Registry("metric")
