"""Ambient occlusion, compared with analytical results."""

import numpy as np
import pytest

from hexmend.kernels import set_threads, threads
from hexmend_app.scene.cutting.polygons import Polygons
from hexmend_app.scene.geometry.occlusion import ambient_light, directions
from hexmend_app.scene.geometry.skin import Skin
from tests.core.grids import grid, scrambled


def faces(mesh, keep=None):
    """Return the visible faces of a mesh as polygons, and the hex of each."""
    found = Skin(mesh).visible(keep)
    k = len(found.quads)
    places = found.quads.ravel().astype(np.int64)
    return Polygons(found.places(mesh.points), 4 * np.arange(k + 1), places, np.arange(k)), found.hexes


def centres(polygons):
    """Return the centres of quads, (k, 3)."""
    return polygons.points[polygons.places].reshape(-1, 4, 3).mean(axis=1)


def of_faces(answer):
    """Return the mean value of the corners of each quad, (k,)."""
    return answer.reshape(-1, 4).mean(axis=1)


def test_directions_are_distributed_evenly():
    all_around = directions(64)
    np.testing.assert_allclose(np.linalg.norm(all_around, axis=1), 1)
    np.testing.assert_allclose(all_around.mean(axis=0), 0, atol=0.02)
    # The mean of d d^T over a sphere is a third of the identity.
    np.testing.assert_allclose(all_around.T @ all_around / 64, np.eye(3) / 3, atol=0.02)


def test_a_convex_body_is_fully_exposed():
    np.testing.assert_array_equal(ambient_light(faces(grid(4, 3, 2))[0]), 1)


def test_a_floor_has_less_light_near_a_wall():
    """An infinite wall of height h blocks (1 - d / sqrt(d² + h²)) / 2 of the light of a floor at distance d."""
    mesh = grid(12, 60, 7)
    middle = mesh.points[mesh.hexes].mean(axis=1)
    keep = (middle[:, 0] < 1) | (middle[:, 2] < 1)  # a floor of height 1, a wall of height 6 over it
    polygons, _ = faces(mesh, keep)
    at = centres(polygons)
    floor = (at[:, 2] == 1) & (at[:, 0] > 1) & (np.abs(at[:, 1] - 30) < 8)
    away = at[floor, 0] - 1
    expected = 1 - (1 - away / np.hypot(away, 6)) / 2
    got = of_faces(ambient_light(polygons))[floor]
    np.testing.assert_allclose(got, expected, atol=0.05)
    nearest, furthest = got[away == away.min()].mean(), got[away == away.max()].mean()
    assert nearest < 0.6 < 0.8 < furthest


def test_an_enclosed_cavity_has_no_light():
    mesh = grid(3, 3, 3)
    keep = np.ones(27, bool)
    keep[13] = False
    polygons, _ = faces(mesh, keep)
    inside = (np.abs(centres(polygons) - 1.5) <= 0.5).all(axis=1)
    assert inside.sum() == 6
    answer = of_faces(ambient_light(polygons))
    assert (answer[inside] == 0).all()
    assert (answer[~inside] == 1).all()


@pytest.mark.parametrize(("size", "far"), [(1e-6, 0.0), (1e6, 0.0), (1.0, 1e4)])
def test_light_is_invariant_under_scaling_and_translation(size, far):
    mesh = grid(5, 5, 5)
    keep = np.random.default_rng(0).random(mesh.n_hexes) < 0.6
    here, there = faces(mesh, keep)[0], faces(mesh.with_points(size * mesh.points + far), keep)[0]
    # Not to the bit: a pixel at the edge of a face may go to either side.
    difference = ambient_light(here) - ambient_light(there)
    assert np.abs(difference).mean() < 0.01


def test_the_result_does_not_depend_on_the_number_of_threads():
    mesh = grid(6, 6, 6)
    polygons, _ = faces(scrambled(mesh, 0.3, 1), np.random.default_rng(1).random(mesh.n_hexes) < 0.5)
    before, answers = threads(), []
    try:
        for count in (1, 2, 5):
            set_threads(count)
            answers.append(ambient_light(polygons))
    finally:
        set_threads(before)
    assert all((answer == answers[0]).all() for answer in answers)


def test_the_computation_can_be_cancelled():
    asked = []
    polygons, _ = faces(grid(2, 2, 2))
    assert ambient_light(polygons, lambda: asked.append(1) or len(asked) < 3) is None
    assert len(asked) == 3
