"""Values and worst hexes of a metric by its name, for `Mesh.quality` and `Mesh.worst`.

Quality of hexes against the target of their mesh, `hexmend.Mesh.element_target`.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from hexmend.errors import MeshError, ParameterError
from hexmend.kernels import elements
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.validation import as_reals
from hexmend.parameters import Parameter
from hexmend.quality.measure import ElementQuality, measure
from hexmend.quality.metric import METRICS, Metric

_COUNT = Parameter("count", int, 10, 0, None, None, "", "")


def metric_values(mesh: Mesh, metric: str = "q") -> np.ndarray:
    """Compute the values of a metric, one for each hex.

    Parameters
    ----------
    mesh : Mesh
    metric : str
        Name in `METRICS`; underscores count as dashes.

    Returns
    -------
    (m,) float64

    Raises
    ------
    ParameterError
        For a metric that does not exist.

    Examples
    --------
    >>> from hexmend.gallery import make
    >>> float(metric_values(make("cube", size=8), "scaled_jacobian").min())
    1.0
    """
    return _of(mesh, metric)[1]


def worst_hexes(mesh: Mesh, count: int = 10, metric: str = "q") -> np.ndarray:
    """Find the worst hexes: inverted ones, then those that are invalid inside, then the others, each by a metric.

    Parameters
    ----------
    mesh : Mesh
    count : int
        Largest number of hexes to be returned.
    metric : str
        Name in `METRICS` of a metric that has a better end; underscores count as dashes.

    Returns
    -------
    (at most count,) int64
        Numbers of hexes, worst first.

    Raises
    ------
    ParameterError
        For a metric that does not exist or has no better end, and for a count that is not a whole number from 0.

    Examples
    --------
    >>> from hexmend.gallery import make
    >>> worst_hexes(make("bridge-sharp", size=500), 3).size
    3
    """
    declared, found, quality = _of(mesh, metric)
    if not declared.better:
        raise ParameterError(f"of {declared.name} neither a high nor a low value is better: there are no worst hexes")
    return rank_worst(found, quality, _COUNT.check(count), declared.better)


def find_metric(name: str) -> Metric:
    """Return the metric of a name; underscores count as dashes. Raises `ParameterError` for an unknown name.

    >>> find_metric("scaled_jacobian").title
    'Scaled Jacobian'
    """
    return METRICS[str(name).replace("_", "-")]


def measure_mesh(mesh: Mesh) -> ElementQuality:
    """Measure the quality of every hex; the mesh remembers the number of invalid hexes for its representation."""
    quality = measure(mesh.points, mesh.elements, mesh.mid_nodes)
    mesh._set(_invalid=quality.n_invalid)
    return quality


def _of(mesh: Mesh, metric: str) -> tuple[Metric, np.ndarray, ElementQuality]:
    declared = find_metric(metric)
    quality = measure_mesh(mesh)
    return declared, declared.values(mesh, quality), quality


def rank_worst(values: np.ndarray, quality: ElementQuality, count: int, better: int = 1) -> np.ndarray:
    """Find the worst hexes: inverted ones, then those that are invalid inside, then the others, each by a metric.

    Among equal values, such as q = 0, the lower scaled Jacobian comes first, then the lower number. NaN is the worst.

    Parameters
    ----------
    values : (m,) float64
        Values of the metric.
    quality : ElementQuality
        Quality of the same hexes.
    count : int
        Largest number of hexes to be returned.
    better : int
        +1 if higher values are better, -1 if lower ones are.

    Returns
    -------
    (at most count,) int64
        Numbers of hexes, worst first.

    Raises
    ------
    MeshError
        For values of another shape or type.
    """
    keys = better * as_reals(values, "values")
    if keys.shape != quality.q.shape:
        raise MeshError(f"values have shape {keys.shape}: expected {quality.q.shape}, one for each hex")
    keys[np.isnan(keys)] = -np.inf
    soundness = 2 - quality.invalid.astype(np.int8) - quality.inverted
    numbers = _least(soundness, np.arange(keys.size), count, keys, quality.scaled_jacobian)
    return numbers[np.lexsort((numbers, quality.scaled_jacobian[numbers], keys[numbers], soundness[numbers]))]


def _least(keys: np.ndarray, numbers: np.ndarray, count: int, *others: np.ndarray) -> np.ndarray:
    """Select the `count` hexes with the least keys, in no order; ties are decided by the other keys."""
    if count >= numbers.size:
        return numbers
    mine = keys[numbers]
    bound = np.partition(mine, count - 1)[count - 1] if count else -np.inf
    below, equal = numbers[mine < bound], numbers[mine == bound]
    missing = count - below.size
    return np.concatenate([below, _least(others[0], equal, missing, *others[1:]) if others else equal[:missing]])


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
    q, eta = np.empty((2, mesh.n_elements))
    elements.measure_against(points, mesh.elements, target.matrices, q, eta)
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
    return measure_against_target(mesh, mesh.points, measure(mesh.points, mesh.elements)).q
