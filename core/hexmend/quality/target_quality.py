"""Quality of hexes against the target of their mesh, `hexmend.Mesh.element_target`."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from hexmend.kernels import elements
from hexmend.mesh.mesh import Mesh
from hexmend.quality.measure import ElementQuality, measure


def measure_against_target(mesh: Mesh, points: np.ndarray, quality: ElementQuality) -> ElementQuality:
    """Measure q and eta of hexes against their target; all else is taken from their quality.

    Parameters
    ----------
    mesh : Mesh
        Its target is used, and its hexes.
    points : (n, 3) float64
    quality : ElementQuality
        Of the mesh's hexes at these points.

    Returns
    -------
    ElementQuality
        `quality` itself if the mesh has no target.
    """
    target = mesh.element_target
    if target is None:
        return quality
    q, eta = np.empty((2, mesh.n_hexes))
    elements.measure_against(points, mesh.hexes, target.matrices, q, eta)
    return replace(quality, q=q, eta=eta, against_target=True)


def target_quality(mesh: Mesh) -> np.ndarray:
    """Compute q(H) of every hex against its target: the mean of 1/eta(T) over its corners, S W^-1 in place of S.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    (m,) float64
        In [0, 1]: 1 for a block as the target wants it; q(H) if the mesh has no target.

    Examples
    --------
    >>> from hexmend.gallery import make
    >>> from hexmend.mesh.element_target import Target
    >>> cube = make("cube", size=8)
    >>> target_quality(cube.with_element_target(Target([[1.0, 1.0, 8.0]] * 8))).round(3).tolist()[0]
    0.372
    """
    return measure_against_target(mesh, mesh.points, measure(mesh.points, mesh.hexes)).q
