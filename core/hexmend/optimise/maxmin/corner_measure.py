"""Measures of corners whose least is maximised: the scaled Jacobian, and the explicit time step."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from hexmend.optimise.maxmin.corner_heights import height_gradients, least_corner_heights
from hexmend.optimise.maxmin.corner_values import gradients, scaled_jacobians


@dataclass(frozen=True, eq=False)
class CornerModels:
    """Smooth functions whose least at each corner is the value of the corner, at some points.

    Parameters
    ----------
    corner : (r,) int
        Index of the corner of each function.
    values : (r,) float64
    derivatives : (r, 4, 3) float64
        By the apex and the ends of the corner's edges.
    """

    corner: np.ndarray
    values: np.ndarray
    derivatives: np.ndarray


@dataclass(frozen=True)
class CornerMeasure:
    """Measure of corners; its values are comparable with scaled Jacobians: most are between -1 and 1.

    Parameters
    ----------
    title : str
        Name for messages.
    values : callable
        Computes the values (k, 8) of hexes (k, 8) at points (n, 3).
    models : callable
        Computes the `CornerModels` of corners (k, 4), apex and ends of the edges each, at points (n, 3).
    unit : float
        What a value of 1 is, in the mesh's unit of length; 1 for a dimensionless measure.
    form : str
        Format of values in messages.
    """

    title: str
    values: Callable[[np.ndarray, np.ndarray], np.ndarray]
    models: Callable[[np.ndarray, np.ndarray], CornerModels]
    unit: float = 1.0
    form: str = ".4f"

    def text(self, value: float) -> str:
        """Format a value for a message, in the mesh's unit."""
        return f"{value * self.unit:{self.form}}"


def _jacobian_models(points: np.ndarray, corners: np.ndarray) -> CornerModels:
    return CornerModels(np.arange(len(corners)), *gradients(points, corners))


SCALED_JACOBIAN = CornerMeasure("scaled Jacobian", scaled_jacobians, _jacobian_models)


def time_step_measure(unit: float) -> CornerMeasure:
    """Make the measure of the explicit time step at wave speed 1: the least of the three heights of a corner.

    Parameters
    ----------
    unit : float
        Time step that counts as 1, such as the least at the start.

    Returns
    -------
    CornerMeasure
    """

    def models(points: np.ndarray, corners: np.ndarray) -> CornerModels:
        values, derivatives = height_gradients(points, corners)
        corner = np.repeat(np.arange(len(corners)), 3)
        return CornerModels(corner, values.ravel() / unit, derivatives.reshape(-1, 4, 3) / unit)

    def values(points: np.ndarray, hexes: np.ndarray) -> np.ndarray:
        return least_corner_heights(points, hexes) / unit

    return CornerMeasure("time step", values, models, unit, ".4g")
