"""Distances of samples of a boundary and of the surface on which it slides from each other."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import NamedTuple

import numpy as np

from hexmend.arrays import row_norms


@dataclass(frozen=True, eq=False)
class Deviations:
    """Samples of one surface that lie further from the other than a limit.

    Parameters
    ----------
    indices : (k,) int64
        Numbers of these samples, ascending.
    distances : (k,) float64
        Distance of each from the closest point of the other surface, in the mesh's unit.
    directions : (k, 3) float64
        Unit vectors from the closest point to the sample: moving along them increases the distance.
    nodes : (k, 4) int
        Boundary nodes whose weighted mean is the sample, or the point closest to it.
    weights : (k, 4) float64
        Weights of these nodes.
    """

    indices: np.ndarray
    distances: np.ndarray
    directions: np.ndarray
    nodes: np.ndarray
    weights: np.ndarray

    def beyond(self, limit: float) -> Deviations:
        """Return the samples that are further than a higher limit; itself if all are."""
        out = self.distances > limit
        if out.all():
            return self
        return Deviations(*(getattr(self, field.name)[out] for field in fields(self)))


class InitialDistances(NamedTuple):
    """Distances of samples of a surface from the boundary before sliding.

    Parameters
    ----------
    distances : (s,) float64
        In the mesh's unit.
    nodes : (s, 4) int
        Boundary nodes whose weighted mean is the closest point.
    weights : (s, 4) float64
        Their weights.
    """

    distances: np.ndarray
    nodes: np.ndarray
    weights: np.ndarray


def deviations_above(
    limit: np.ndarray, indices: np.ndarray, x: np.ndarray, closest: np.ndarray, nodes: np.ndarray, weights: np.ndarray
) -> Deviations:
    """Deviations of the samples x (k, 3) whose distance from the closest points (k, 3) exceeds a limit (k,)."""
    away = x - closest
    distances = row_norms(away)
    out = distances > limit
    directions = away[out] / np.maximum(distances[out], np.finfo(float).tiny)[:, None]
    return Deviations(indices[out], distances[out], directions, nodes[out], weights[out])
