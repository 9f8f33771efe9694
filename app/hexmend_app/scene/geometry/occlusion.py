"""Ambient occlusion: faces deep in a cut are darker than exposed ones.

Occlusion is computed in the scene, not in screen space, so it does not change with the camera.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import numpy as np

from hexmend.kernels import occlusion
from hexmend_app.scene.geometry.polygons import Polygons

#: Number of light directions. At most half of them reach a face.
DIRECTIONS = 64

#: Number of directions that are computed between checks for cancellation.
_BATCH = 16

#: Smallest brightness, at which colours are still distinguishable.
DARKEST = 0.55

#: Desired length of hex edges in depth maps, in pixels, and the smallest and largest side of depth maps.
_PIXELS, _SIDES = 5.0, (384, 768)


@cache
def directions(count: int = DIRECTIONS) -> np.ndarray:
    """Return unit vectors, (count, 3) float64, spread evenly on a spiral over the sphere."""
    steps = np.arange(count)
    z = 1 - (2 * steps + 1) / count
    angle = np.pi * (3 - np.sqrt(5)) * steps
    radius = np.sqrt(1 - z * z)
    vectors = np.column_stack([radius * np.cos(angle), radius * np.sin(angle), z])
    vectors.flags.writeable = False
    return vectors


def ambient_light(polygons: Polygons, wanted: Callable[[], bool] = lambda: True) -> np.ndarray | None:
    """Compute the share of ambient light that reaches each corner of polygons.

    Parameters
    ----------
    polygons : Polygons
        All polygons of the scene, counter-clockwise as seen from outside.
    wanted : callable
        Called repeatedly; returns False to cancel.

    Returns
    -------
    (start[-1],) float64, optional
        0 for enclosed corners, 1 for fully exposed corners; None if cancelled.
    """
    corners = len(polygons.places)
    if not corners:
        return np.ones(0)
    side, batches = _depth_map_side(polygons), len(directions()) // _BATCH
    received, total, face_normals = np.zeros(corners), np.zeros(corners), normals(polygons)
    for batch in np.array_split(directions(), batches):
        if not wanted():
            return None
        occlusion.shine(polygons.points, polygons.start, polygons.places, face_normals, batch, side, received, total)
    return np.divide(received, total, out=np.ones(corners), where=total > 0)


def normals(polygons: Polygons) -> np.ndarray:
    """Return the unit normals of the mean planes of polygons, (k, 3) float64, which hide diagonals of warped quads."""
    unit_normals = np.empty((len(polygons), 3))
    occlusion.normals(polygons.points, polygons.start, polygons.places, unit_normals)
    return unit_normals


def brightness(light: np.ndarray) -> np.ndarray:
    """Return the brightness of colours, from `DARKEST` to 1, under a fraction of the ambient light."""
    return DARKEST + (1 - DARKEST) * light


def _depth_map_side(polygons: Polygons) -> int:
    """Return the side of depth maps in pixels, in which edges of hexes have enough pixels."""
    sample = polygons.start[:-1][:: max(1, len(polygons) // 2000)]
    ends = polygons.points[polygons.places[sample]], polygons.points[polygons.places[sample + 1]]
    edge = float(np.median(np.linalg.norm(ends[1] - ends[0], axis=1)))
    extent = float(np.linalg.norm(np.ptp(polygons.points[polygons.places], axis=0)))
    smallest, largest = _SIDES
    return int(np.clip(_PIXELS * extent / edge, smallest, largest)) if edge > 0 else largest
