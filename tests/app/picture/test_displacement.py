"""Displacements and changes since a reference state."""

import numpy as np
import pytest

from hexmend.quality import measure
from hexmend_app.picture.displacement import (
    MENDED,
    NEWLY_INVALID,
    STILL_INVALID,
    Displacement,
    ReferenceState,
)
from tests.core.boundary.solids import slid
from tests.core.grids import grid, scrambled

MESH = grid(5)


def moved(points, before=None):
    then = MESH.points if before is None else before
    was = ReferenceState(then, measure(then, MESH.hexes), "then")
    return Displacement(MESH, was, points, measure(points, MESH.hexes))


def test_displacement_of_an_element_is_that_of_its_nodes_in_mean_edge_lengths():
    points = scrambled(MESH, 0.7).points
    movement = moved(points)
    lengths = np.linalg.norm(points - MESH.points, axis=1)[MESH.hexes] / MESH.mean_edge_length
    np.testing.assert_allclose(movement.values("moved-most"), lengths.max(axis=1), rtol=1e-12)
    np.testing.assert_allclose(movement.values("moved-mean"), lengths.mean(axis=1), rtol=1e-12)
    assert movement.counts.largest == pytest.approx(lengths.max())


def test_hexes_are_newly_invalid_still_invalid_or_mended_also_those_invalid_inside():
    good, bad = MESH.points, scrambled(MESH, 0.6).points
    figures = measure(bad, MESH.hexes)
    invalid = figures.invalid
    assert figures.n_inverted < invalid.sum() < invalid.size
    assert np.array_equal(moved(bad).validity_changes == NEWLY_INVALID, invalid)
    assert np.array_equal(moved(good, bad).validity_changes == MENDED, invalid)
    assert np.array_equal(moved(bad, bad).validity_changes == STILL_INVALID, invalid)
    assert moved(bad).counts.newly_invalid == moved(good, bad).counts.mended == invalid.sum()
    assert moved(bad).counts.worse == moved(good, bad).counts.better > 0


def test_what_slides_within_a_face_stays_on_the_surface():
    movement = moved(slid(MESH, 0.3, seed=1).points)
    assert movement.distances[MESH.topology.boundary].max() > 0.2
    assert movement.values("surface-distance").max() < 1e-12
    assert 0 < movement.counts.slid == movement.counts.moved - 64
    assert moved(scrambled(MESH, 0.3).points).counts.slid == 0


def test_distance_from_the_surface_is_that_of_boundary_nodes_alone():
    points = MESH.points.copy()
    on_face = (points[:, 0] == 0) & ((points[:, 1:] > 0) & (points[:, 1:] < 5)).all(axis=1)
    points[np.flatnonzero(on_face)[0]] += (-0.25, 0.1, 0)  # across the face, and along it
    points[np.flatnonzero(MESH.free)[-1]] += 0.3
    movement = moved(points)
    values = movement.values("surface-distance")
    beside = (MESH.hexes == np.flatnonzero(on_face)[0]).any(axis=1)
    np.testing.assert_allclose(values[beside], 0.25, rtol=1e-12)
    assert not values[~beside].any()
    assert movement.updated(points, movement.quality).before.skin(MESH) is movement.before.skin(MESH)
