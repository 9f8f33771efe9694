"""Face quality: known values, agreement with plain loops by OpenFOAM's definitions, invariance."""

import math

import numpy as np
import pytest

from hexmend.mesh.hexahedron import FACES, UNIT_CUBE
from hexmend.quality import METRICS, measure
from hexmend.quality.finite_volume import cell_geometry, face_quality
from tests.core.grids import grid, scrambled


def measured(mesh):
    return face_quality(cell_geometry(mesh.points, mesh.hexes), mesh.hexes, mesh.topology.face_neighbours)


def by_loops(mesh):
    """The same by plain loops over faces, as the comments of primitiveMeshTools.C have it."""

    def face(points):
        middle = points.mean(axis=0)
        total, weighted, area = 0.0, np.zeros(3), np.zeros(3)
        for a, b in zip(points, np.roll(points, -1, axis=0), strict=True):
            normal = np.cross(b - a, middle - a)
            size = np.linalg.norm(normal)
            area, total, weighted = area + normal / 2, total + size, weighted + size * (a + b + middle) / 3
        return weighted / total, area

    centres, volumes = [], []
    for nodes in mesh.hexes:
        sides = [face(mesh.points[nodes[side]]) for side in FACES]
        estimate = np.mean([centre for centre, _ in sides], axis=0)
        pyramids = [area @ (centre - estimate) for centre, area in sides]
        weighted = sum(p * (0.75 * c + 0.25 * estimate) for p, (c, _) in zip(pyramids, sides, strict=True))
        centres.append(weighted / sum(pyramids))
        volumes.append(sum(pyramids) / 3)
    found = []
    for h, side in np.ndindex(mesh.n_hexes, 6):
        other = mesh.topology.face_neighbours[h, side]
        if 0 <= other < h:
            continue
        corners = mesh.points[mesh.hexes[h, FACES[side]]]
        centre, S = face(corners)
        n, towards = S / np.linalg.norm(S), centre - centres[h]
        d = centres[other] - centres[h] if other >= 0 else n * (n @ towards)
        angle = math.degrees(math.acos(min(1, d @ S / (np.linalg.norm(d) * np.linalg.norm(S))))) if other >= 0 else 0
        s = towards - (S @ towards) / (S @ d) * d
        way = s / (np.linalg.norm(s) + 1e-150)
        extent = max((0.2 if other >= 0 else 0.4) * np.linalg.norm(d), *(abs(way @ (x - centre)) for x in corners))
        own, beyond = (abs(S @ towards), abs(S @ (centres[other] - centre))) if other >= 0 else (1, 1)
        v, w = (volumes[h], volumes[other]) if other >= 0 else (1, 1)
        triangles = sum(
            np.linalg.norm(np.cross(b - a, centre - a)) / 2
            for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True)
        )
        found.append((angle, np.linalg.norm(s) / extent, min(own, beyond) / (own + beyond), min(v, w) / max(v, w),
                      np.linalg.norm(S) / triangles))  # fmt: skip
    return np.array(found).T


@pytest.mark.parametrize("amplitude", [0.1, 0.25])
def test_all_is_that_of_plain_loops(amplitude):
    mesh = scrambled(grid(3, 4, 2), amplitude)
    faces = measured(mesh)
    expected = by_loops(mesh)
    got = faces.non_orthogonality, faces.skewness, faces.weight, faces.volume_ratio, faces.flatness
    for one, plain in zip(got, expected, strict=True):
        np.testing.assert_allclose(one, plain, rtol=1e-9, atol=1e-7)


@pytest.mark.parametrize("degrees", [0, 10, 45, 70.5, 85])
def test_a_sheared_lattice_has_the_angle_of_the_shear(degrees):
    mesh = grid(3)
    lean = math.tan(math.radians(degrees))
    faces = measured(mesh.with_points(mesh.points @ [[1, 0, 0], [0, 1, 0], [lean, 0, 1]]))
    angles = faces.non_orthogonality[faces.internal]
    # d leaves the planes of z by the shear; those of x lean by as much against d along x.
    assert angles.max() == pytest.approx(degrees, abs=1e-6)
    assert np.count_nonzero(angles > degrees / 2) == (36 if degrees else 0)
    np.testing.assert_allclose(faces.skewness[faces.internal], 0, atol=1e-9)


def test_volumes_and_centres_are_those_of_the_solid():
    mesh = scrambled(grid(3), 0.3)
    cells = cell_geometry(mesh.points, mesh.hexes)
    assert (cells.volumes * cells.unit**3).sum() == pytest.approx(27)
    one = cell_geometry(UNIT_CUBE * [1, 2, 3] + 5, np.arange(8, dtype=np.int32)[None])
    assert one.volumes[0] * one.unit**3 == pytest.approx(6)
    np.testing.assert_allclose(one.centres, 0, atol=1e-15)


def test_metrics_are_the_worst_of_the_faces():
    mesh = scrambled(grid(4), 0.3)
    faces, figures = measured(mesh), measure(mesh.points, mesh.hexes)
    for name, values, choose in (
        ("non-orthogonality", faces.non_orthogonality, max),
        ("face-skewness", faces.skewness, max),
        ("face-weight", faces.weight, min),
        ("volume-ratio", faces.volume_ratio, min),
    ):
        worst = METRICS[name].values(mesh, figures)
        np.testing.assert_array_equal(worst, METRICS[name].of(mesh.points, mesh.hexes, figures))
        for h in (0, 21, 63):
            own = values[(faces.owner == h) | (faces.neighbour == h)]
            assert worst[h] == choose(own)


def test_other_points_have_other_values_though_the_last_are_kept():
    first, second = (scrambled(grid(4), 0.3, seed) for seed in (1, 2))
    metric, figures = METRICS["face-skewness"], measure(first.points, first.hexes)
    one = metric.values(first, figures)
    assert metric.values(first, figures) is one
    other = metric.values(second, measure(second.points, second.hexes))
    assert (one != other).any()
    np.testing.assert_array_equal(metric.values(first, figures), one)
