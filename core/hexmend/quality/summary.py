"""Measurement of the summary of a mesh, and of the objective that smoothing minimises."""

from __future__ import annotations

import numpy as np

from hexmend.mesh.mesh import Mesh
from hexmend.quality.measure import ElementQuality, locked_hexes, measure
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
    quality = quality or measure(mesh.points, mesh.hexes, mesh.mid_nodes)
    mesh._set(_invalid=quality.n_invalid)  # for its representation
    q = quality.q
    return Summary(
        hexes=mesh.n_hexes,
        nodes=int(np.count_nonzero(mesh.topology.used)),
        free_nodes=int(np.count_nonzero(mesh.free)),
        inverted=quality.n_inverted,
        locked_inverted=int(np.count_nonzero(locked_hexes(mesh.points, mesh.hexes, mesh.fixed, quality.inverted))),
        invalid=quality.n_invalid,
        min_jacobian=least_jacobian(mesh.points, mesh.hexes, mesh.mid_nodes),
        q_min=float(q.min()),
        q_mean=float(q.mean()),
        q_max=float(q.max()),
        q_std=float(q.std()),
        q_norm=float(1 / np.sqrt(np.mean(1 / np.square(q)))) if q.min() > 0 else 0.0,
        scaled_jacobian_min=float(quality.scaled_jacobian.min()),
        objective=objective(quality),
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
