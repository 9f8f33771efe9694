"""Unstructured quad meshes of a regular pentagon, with a given number of quads and of nodes on its boundary.

By Euler's formula a mesh of Q quads with b boundary nodes has Q - b / 2 + 1 interior nodes.

Pairing of triangles into quads with angles as close to 90° as possible.
"""

from __future__ import annotations

from itertools import count

import numpy as np

from hexmend.gallery.gallery_mesh import grid_quads


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


#: Corners, counter-clockwise, on the unit circle.
CORNERS = np.column_stack([np.cos(0.4 * np.pi * np.arange(5)), np.sin(0.4 * np.pi * np.arange(5))])
#: Number of relaxation sweeps of interior points.
SWEEPS = 30


def pentagon(quads: int, boundary: int, jitter: float = 0.4, seed: int = 0) -> tuple[np.ndarray, np.ndarray]:
    """Build an unstructured mesh of convex quads in the pentagon.

    A ring of quads is paved along the boundary. Inside, points of a lattice are relaxed as by Lloyd's method, and their
    Delaunay triangles are paired into quads. Each interior node then moves half way to its position in the Tutte
    embedding (1963), which leaves room for improvement by smoothing, or all the way if quads are not convex before; in
    the embedding all are.

    Parameters
    ----------
    quads : int
        Number of quads.
    boundary : int
        Number of boundary nodes: even, and at least 15.
    jitter : float
        Largest displacement of lattice points over the lattice spacing. 0.05 leaves a grid that is irregular only near
        the ring, 0.6 none of it.
    seed : int
        First seed; the next one is tried if triangles cannot be paired.

    Returns
    -------
    points : (n, 2) float64
        Boundary points first, starting at the first corner.
    quads : (k, 4) int64
        Counter-clockwise.

    Examples
    --------
    >>> points, quads = pentagon(245, 70)
    >>> points.shape, quads.shape
    ((281, 2), (245, 4))
    """
    rim, paved = _paved_ring(boundary)
    ring = rim[boundary:]
    for attempt in count(seed):
        points = _relax(ring, _lattice(len(ring), quads - boundary // 2 + 1 - len(ring), jitter, attempt))
        triangles = _triangles(points)
        degree = np.bincount(_edges(triangles).ravel())
        degree[: len(ring)] += 1  # the edge to the boundary
        matched = pair_triangles(points, triangles, degree - 3)
        if matched is None:
            continue
        found = np.concatenate([paved, matched + boundary])
        points = np.concatenate([rim[:boundary], points])
        smooth = _tutte_embedding(points, found, boundary)
        for placed in ((points + smooth) / 2, smooth):
            if corner_angles(placed, found).max() < np.pi:
                return placed, found
    raise AssertionError("unreachable")


def subdivide(points: np.ndarray, quads: np.ndarray, times: int) -> tuple[np.ndarray, np.ndarray]:
    """Subdivide each quad into a bilinear grid of times x times quads; arrays are those of `pentagon`."""
    v, u = (grid[..., None] for grid in np.meshgrid(*[np.linspace(0, 1, times + 1)] * 2, indexing="ij"))
    a, b, c, d = (points[quads[:, i], None, None] for i in range(4))
    grid_points = ((1 - u) * (1 - v) * a + u * (1 - v) * b + u * v * c + (1 - u) * v * d).reshape(-1, 2)
    _, first, inverse = np.unique(np.round(grid_points, 9) + 0.0, axis=0, return_index=True, return_inverse=True)
    number = inverse.reshape(len(quads), times + 1, times + 1)
    return grid_points[first], grid_quads(number)


def fan() -> tuple[np.ndarray, np.ndarray]:
    """Build the coarsest mesh, five quads around the centre; arrays are those of `pentagon`."""
    points = np.concatenate([_polygon(CORNERS, np.full(5, 2)), np.zeros((1, 2))])
    i = np.arange(5)
    return points, np.column_stack([np.full(5, 10), (2 * i - 1) % 10, 2 * i, 2 * i + 1])


def _polygon(corners: np.ndarray, segments: np.ndarray) -> np.ndarray:
    """Equally spaced points along each side of a pentagon, segments (5,) of them from each corner."""
    at = np.concatenate([k + np.arange(n) / n for k, n in enumerate(segments)])
    return np.column_stack([np.interp(at, np.arange(6), [*column, column[0]]) for column in corners.T])


def _paved_ring(boundary: int) -> tuple[np.ndarray, np.ndarray]:
    """Points of the boundary and of the ring's inner side, and the ring's quads with one in each corner."""
    segments = np.diff(np.round(np.arange(6) * boundary / 5).astype(int))
    depth = 1 - 10 * np.tan(np.pi / 5) / boundary  # scale of the ring's inner side, so that its quads are square
    points = np.concatenate([_polygon(CORNERS, segments), _polygon(depth * CORNERS, segments - 2)])
    outer, inner = 0, 0
    rows: list[np.ndarray] = []
    for n in segments:
        i = np.arange(n - 2)
        first = boundary + inner
        adjacent = boundary + (inner + i + 1) % (boundary - 10)
        rows.append(np.array([[(outer - 1) % boundary, outer, outer + 1, first]]))
        rows.append(np.column_stack([outer + 1 + i, outer + 2 + i, adjacent, first + i]))
        outer, inner = outer + n, inner + n - 2
    quads = np.concatenate(rows)
    quads[quads == boundary + (boundary - 10)] = boundary
    return points, quads


def _lattice(ring: int, wanted: int, jitter: float, seed: int) -> np.ndarray:
    """The `wanted` points nearest to the centre of a rotated, shifted and jittered lattice, scaled into the ring."""
    random = np.random.default_rng(seed)
    shift, turn = random.uniform(size=2), random.uniform(0, np.pi / 2)
    reach = int(np.sqrt(wanted)) + 4
    x, y = np.meshgrid(np.arange(-reach, reach + 1), np.arange(-reach, reach + 1))
    points = np.column_stack([x.ravel(), y.ravel()]) + shift
    points += random.uniform(-jitter, jitter, points.shape)
    c, s = np.cos(turn), np.sin(turn)
    points = points @ [[c, s], [-s, c]]
    gauge = (points @ -CORNERS.T).max(axis=1)  # 1 on the sides of the pentagon whose inner radius is 1
    nearest = np.argsort(gauge, kind="stable")[:wanted]
    inside = np.cos(np.pi / 5) * (1 - 2.2 * np.tan(np.pi / 5) * 5 / (ring + 10) * 1.2)
    return points[nearest] * inside / gauge[nearest[-1]]


def _triangles(points: np.ndarray) -> np.ndarray:
    """Delaunay triangles, counter-clockwise, (t, 3), without the flat ones along straight sides."""
    from scipy.spatial import Delaunay

    triangles = Delaunay(points).simplices.astype(np.int64)
    area = _double_area(points, triangles)
    return triangles[area > 1e-6 * area.mean()]


def _relax(ring: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Ring nodes and points, the points moved SWEEPS times to the centroids of the triangles around them."""
    points = np.concatenate([ring, points])
    for _ in range(SWEEPS):
        triangles = _triangles(points)
        weight = np.repeat(_double_area(points, triangles), 3)
        centre = np.repeat(points[triangles].mean(axis=1), 3, axis=0)
        total = [np.bincount(triangles.ravel(), weight * c, len(points)) for c in (*centre.T, np.ones(len(weight)))]
        points[len(ring) :] = (np.array(total[:2]) / total[2]).T[len(ring) :]
    return points


def _double_area(points: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Twice the areas of triangles, (t,)."""
    (ax, ay), (bx, by) = ((points[triangles[:, i]] - points[triangles[:, 0]]).T for i in (1, 2))
    return ax * by - ay * bx


def _edges(polygons: np.ndarray) -> np.ndarray:
    """Edges of polygons (m, k), lower node first, (e, 2)."""
    return np.unique(np.sort(polygon_sides(polygons), axis=1), axis=0)


def _tutte_embedding(points: np.ndarray, quads: np.ndarray, boundary: int) -> np.ndarray:
    """Move interior nodes, those after the first `boundary`, to the means of their edge neighbours."""
    from scipy.sparse import coo_array, diags_array
    from scipy.sparse.linalg import spsolve

    sides = _edges(quads)
    ends = np.concatenate([sides, sides[:, ::-1]]).T
    adjacent = coo_array((np.ones(len(ends[0])), ends), (len(points), len(points))).tocsr()
    laplacian = (diags_array(adjacent.sum(axis=1)) - adjacent).tocsr()[boundary:]
    placed = points.copy()
    placed[boundary:] = spsolve(laplacian[:, boundary:].tocsc(), -laplacian[:, :boundary] @ points[:boundary])
    return placed
