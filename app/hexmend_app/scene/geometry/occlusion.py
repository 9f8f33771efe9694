"""Ambient occlusion: faces deep in a cut are darker than exposed ones.

It is worked out on the scene itself and not in its picture, so that it stays as the camera turns.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import numpy as np

from hexmend.kernels import occlusion
from hexmend_app.scene.cutting.polygons import Polygons

#: Directions that light comes from. Half of them reach a face at best.
DIRECTIONS = 64

#: Directions between which whoever waits for the answer can be asked whether he still does.
_AT_ONCE = 16

#: Darkest shade: colours must stay distinguishable there too.
DARKEST = 0.55

#: Pixels that an edge of an element is to have in the pictures from the light, and the sides that these may have.
_PIXELS, _SIDES = 5.0, (384, 768)


@cache
def directions(count: int = DIRECTIONS) -> np.ndarray:
    """Return evenly spread directions on a spiral over the sphere, (count, 3) float64 of length 1."""
    steps = np.arange(count)
    z = 1 - (2 * steps + 1) / count
    around = np.pi * (3 - np.sqrt(5)) * steps
    flat = np.sqrt(1 - z * z)
    answer = np.column_stack([flat * np.cos(around), flat * np.sin(around), z])
    answer.flags.writeable = False
    return answer


def light(polygons: Polygons, wanted: Callable[[], bool] = lambda: True) -> np.ndarray | None:
    """Compute the share of ambient light that reaches each corner of polygons.

    Parameters
    ----------
    polygons : Polygons
        Everything that stands in the light; counter-clockwise from where they are seen.
    wanted : callable
        Asked now and then; False ends the work.

    Returns
    -------
    (start[-1],) float64, optional
        From 0 for what is shut in to 1 for what nothing is before; None where it is no longer wanted.
    """
    corners = len(polygons.places)
    if not corners:
        return np.ones(0)
    side, steps = _side(polygons), len(directions()) // _AT_ONCE
    reached, whole, along = np.zeros(corners), np.zeros(corners), normals(polygons)
    for some in np.array_split(directions(), steps):
        if not wanted():
            return None
        occlusion.shine(polygons.points, polygons.start, polygons.places, along, some, side, reached, whole)
    return np.divide(reached, whole, out=np.ones(corners), where=whole > 0)


def normals(polygons: Polygons) -> np.ndarray:
    """Return the normals of the mean planes of polygons, (k, 3) float64 of length 1: no diagonal is visible."""
    answer = np.empty((len(polygons), 3))
    occlusion.normals(polygons.points, polygons.start, polygons.places, answer)
    return answer


def brightness(light: np.ndarray) -> np.ndarray:
    """Return the factor of colours under a share of ambient light, from `DARKEST` to 1."""
    return DARKEST + (1 - DARKEST) * light


def _side(polygons: Polygons) -> int:
    """Return the side of the depth picture in which the edge of a hex has enough pixels."""
    some = polygons.start[:-1][:: max(1, len(polygons) // 2000)]
    ends = polygons.points[polygons.places[some]], polygons.points[polygons.places[some + 1]]
    edge = float(np.median(np.linalg.norm(ends[1] - ends[0], axis=1)))
    extent = float(np.linalg.norm(np.ptp(polygons.points[polygons.places], axis=0)))
    least, most = _SIDES
    return int(np.clip(_PIXELS * extent / edge, least, most)) if edge > 0 else most
