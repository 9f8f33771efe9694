"""Pairing of triangles into quads with angles as close to 90° as possible."""

from __future__ import annotations

import numpy as np


def pair_triangles(points: np.ndarray, triangles: np.ndarray, spare: np.ndarray) -> np.ndarray | None:
    """Pair all triangles into quads so that the sum of (angle - 90°)^2 over the corners of all quads is least.

    This integer program is solved to optimality, so that the result does not depend on the solver. A few hundred
    triangles take tenths of a second, a few thousand seconds to a minute.

    Parameters
    ----------
    points : (n, 2) float64
    triangles : (t, 3) int
        Counter-clockwise.
    spare : (n,) int
        Number of edges that each node may lose.

    Returns
    -------
    (t / 2, 4) int64 or None
        Quads, counter-clockwise; None if no pairing exists.
    """
    from scipy.optimize import Bounds, LinearConstraint, milp
    from scipy.sparse import coo_array

    sides = polygon_sides(triangles)
    opposite, triangle = triangles[:, [2, 0, 1]].T.ravel(), np.tile(np.arange(len(triangles)), 3)
    key = np.sort(sides, axis=1) @ [len(points), 1]
    order = np.argsort(key, kind="stable")
    twice = np.flatnonzero(key[order][1:] == key[order][:-1])
    one, other = order[twice], order[twice + 1]  # both sides of each inner edge
    quads = np.column_stack([sides[one, 0], opposite[other], sides[one, 1], opposite[one]])

    k, t = len(one), len(triangles)
    edges = np.concatenate([np.arange(k), np.arange(k)])
    ones = np.ones(2 * k)
    covers = coo_array((ones, (triangle[np.concatenate([one, other])], edges)), (t, k)).tocsr()
    takes = coo_array((ones, (sides[one].T.ravel(), edges)), (len(points), k)).tocsr()
    short = (np.diff(takes.indptr) + 1) // 2 > spare  # of two adjacent edges only one can be removed
    found = milp(
        np.square(corner_angles(points, quads) - np.pi / 2).sum(axis=1),
        integrality=np.ones(k),
        bounds=Bounds(0, 1),
        constraints=[LinearConstraint(covers, 1, 1), LinearConstraint(takes[short], 0, spare[short])],
        options={"mip_rel_gap": 0},
    )
    return None if found.x is None else quads[found.x > 0.5]


def polygon_sides(polygons: np.ndarray) -> np.ndarray:
    """Return the sides of polygons (m, k): the first of each, then the second and so on, (k m, 2)."""
    return np.concatenate([polygons[:, [i, (i + 1) % polygons.shape[1]]] for i in range(polygons.shape[1])])


def corner_angles(points: np.ndarray, quads: np.ndarray) -> np.ndarray:
    """Return the angles at the corners of quads in radians, from 0 to 2 pi, (k, 4) float64."""
    corner = points[quads]
    ahead, behind = np.roll(corner, -1, axis=1) - corner, np.roll(corner, 1, axis=1) - corner
    cross = ahead[..., 0] * behind[..., 1] - ahead[..., 1] * behind[..., 0]
    return np.arctan2(cross, (ahead * behind).sum(axis=-1)) % (2 * np.pi)
