"""Target of a run: the target of the method's parameters, with the layers of the mesh kept.

Heights of layers that are fitted to one first height of the wall.
"""

from __future__ import annotations

import numpy as np

from hexmend.layers.walls import Layers, Wall
from hexmend.mesh.element_target import Target
from hexmend.mesh.mesh import Mesh
from hexmend.parameters import AUTO, SET
from hexmend.quality import ElementQuality, measure
from hexmend.target.builders import make_target
from hexmend.target.sheets import DISTORTED, recovered_lengths

#: Factor by which first heights may differ from the wall's, and the share of columns within it, for a fit.
_MAX_FACTOR, _MIN_SHARE = 2.0, 0.9
#: Range of the factor, from layer to layer, by which heights of a column are changed.
_LEAST, _GREATEST = 0.8, 1.25
#: Bisections for that factor.
_BISECTIONS = 60


def fitted_lengths(lengths: np.ndarray, layers: Layers) -> np.ndarray:
    """Give the layers on each wall one first height; growth makes up for it, so that stacks keep their thickness.

    The first height of a wall is that which most columns have. Columns that were squeezed, such as those over a bump,
    get it too, and grow faster or more slowly than the others. A wall whose first heights differ by more than a factor
    of two has no such height: its layers stay as they are.

    Parameters
    ----------
    lengths : (m, 3) float64
        Lengths of all hexes.
    layers : Layers

    Returns
    -------
    (m, 3) float64
    """
    lengths = lengths.copy()
    for wall in layers.walls:
        heights = _fitted_heights(wall.of(lengths))
        there = wall.hexes >= 0
        lengths[wall.hexes[there], wall.faces[there] // 2] = heights[there]
    return lengths


def first_height(wall: Wall, lengths: np.ndarray) -> float:
    """Height of a wall's first layer that most columns have, in the unit of the lengths (m, 3) of all hexes."""
    return _mode(wall.of(lengths)[:, 0])


def _fitted_heights(heights: np.ndarray) -> np.ndarray:
    """Heights (w, k), NaN where columns have ended, with one first height, and with their sums as before."""
    wanted = _mode(heights[:, 0]) / heights[:, 0]
    if np.mean(np.abs(np.log(wanted)) < np.log(_MAX_FACTOR)) < _MIN_SHARE:
        return heights
    number = np.arange(heights.shape[1])
    total = np.nansum(heights, axis=1)
    low, high = np.full(len(heights), _LEAST), np.full(len(heights), _GREATEST)
    for _ in range(_BISECTIONS):
        factor = np.sqrt(low * high)
        above = np.nansum(heights * wanted[:, None] * factor[:, None] ** number, axis=1) > total
        low, high = np.where(above, low, factor), np.where(above, factor, high)
    fits = (low > _LEAST) & (high < _GREATEST)
    return np.where(fits[:, None], heights * wanted[:, None] * factor[:, None] ** number, heights)


def _mode(values: np.ndarray) -> float:
    """The value around which most of some positive values lie, by halving their sample to its narrowest part."""
    logs = np.sort(np.log(values))
    while logs.size > 2:
        half = (logs.size + 1) // 2
        widths = logs[half - 1 :] - logs[: logs.size - half + 1]
        begin = int(widths.argmin())
        logs = logs[begin : begin + half]
    return float(np.exp(logs.mean()))


#: Treatments of layers: kept unless a target is asked for; kept; treated as the other hexes. Other texts are names of
#: sets, on which layers stand that are kept.
KEEP_LAYERS = ("auto", "keep", "free")
#: Targets in which hexes have their shape as given.
_AS_THEY_ARE = ("given-shape", "given")

#: Aspect ratios between which the target of hexes outside of layers goes from a cube to the shape as given.
_CUBE, _AS_GIVEN = 2.0, 4.0
#: Share of distorted hexes beyond which lengths as given are no measure.
MAX_DISTORTED = 0.01


def keeps_layers(specification: str, layers: str) -> bool:
    """Return True if a run with this target and treatment of layers keeps the layers."""
    return layers not in ("auto", "free") or (layers == "auto" and specification in (AUTO, *_AS_THEY_ARE))


def named_walls(layers: str) -> tuple[str, ...]:
    """Return the names of the sets that a treatment of layers names; empty for those of `KEEP_LAYERS`.

    >>> named_walls("keep"), named_walls("plate, wing"), named_walls("set:keep")
    ((), ('plate', 'wing'), ('keep',))
    """
    if layers in KEEP_LAYERS:
        return ()
    return tuple(name.strip().removeprefix(SET) for name in layers.split(","))


def run_target(
    mesh: Mesh,
    specification: str,
    layers: Layers,
    size_weight: float = 1.0,
    quality: ElementQuality | None = None,
) -> Target | None:
    """Make the target of a run.

    Parameters
    ----------
    mesh : Mesh
        The mesh as given.
    specification : str
        As of `hexmend.target.make_target`, or "auto": the mesh's own target; or else given-shape for a mesh with
        layers, and ideal for one without.
    layers : Layers
        Layers that are kept: their hexes get their own lengths as target. With "given-shape" and "given", and with
        "auto" where they are tangled, heights are fitted to one first height of each wall; see `fitted_lengths`.
    size_weight : float
        Weight of the size relative to the shape, where the target has one.
    quality : ElementQuality, optional
        Of the mesh's hexes, if it is measured already.

    Returns
    -------
    Target or None
        None if all hexes are to be cubes.

    Raises
    ------
    ParameterError
        For a target that does not exist.
    """
    quality = quality or measure(mesh.points, mesh.elements)
    fits = True
    if specification == AUTO:
        if mesh.element_target is not None:
            return mesh.element_target
        specification = "given-shape" if layers else "ideal"
        fits = bool(layers) and np.mean(quality.scaled_jacobian[layers.hexes] < DISTORTED) > MAX_DISTORTED
    target = make_target(mesh, specification, size_weight, quality)
    if not layers or (specification in _AS_THEY_ARE and not fits):
        return target
    own = recovered_lengths(mesh, quality)
    if target is None:
        lengths, weight, name = _towards_cubes(own), 0.0, "ideal"
    else:
        lengths, weight, name = target.lengths.copy(), target.size_weight, target.name
    kept = layers.hexes
    lengths[kept] = (fitted_lengths(own, layers) if specification in _AS_THEY_ARE else own)[kept]
    return Target(lengths, weight, name if specification in _AS_THEY_ARE else f"{name}, layers as given")


def _towards_cubes(lengths: np.ndarray) -> np.ndarray:
    """Lengths (m, 3) of cubes for compact hexes and as given for long or flat ones, with a transition between.

    Long and flat hexes beside layers, such as in a wake, continue them; cubes there would work against the layers.
    """
    logs = np.log(lengths)
    middle = logs.mean(axis=1, keepdims=True)
    aspect = np.ptp(logs, axis=1, keepdims=True)
    share = np.clip((aspect - np.log(_CUBE)) / np.log(_AS_GIVEN / _CUBE), 0, 1)
    return np.exp(middle + share * (logs - middle))
