"""Planes that move along their normals, compared with cuts computed anew; and the coarse picture of what they open."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend_app.picture.cut_shapes import Plane
from hexmend_app.scene.cutting.coarse_section import coarse_section
from hexmend_app.scene.cutting.moving_planes import MOST_PLANES, MovingPlanes
from hexmend_app.scene.geometry.plane_sides import centres_kept
from hexmend_app.scene.geometry.skin import Skin
from tests.core.grids import grid, scrambled

MESH = grid(5, 4, 3)


def planes_of(random, count, along_axes):
    normals = np.eye(3)[random.integers(0, 3, count)] if along_axes else random.normal(size=(count, 3))
    return [Plane(tuple(n), point=tuple(random.uniform(0, 4, 3))) for n in normals]


@given(st.integers(0, 2**32 - 1), st.integers(1, MOST_PLANES + 2), st.booleans(), st.booleans())
def test_what_is_kept_is_what_a_cut_computed_anew_keeps(seed, count, notch, along_axes):
    random, moving = np.random.default_rng(seed), MovingPlanes(MESH)
    for points in (MESH.points, scrambled(MESH, 0.3, seed).points, MESH.points):
        planes = planes_of(random, count, along_axes)
        for _ in range(2):
            normals, offsets = zip(*(plane.equation for plane in planes), strict=True)
            expected = centres_kept(points, MESH.hexes, np.array(normals), np.array(offsets), notch)
            np.testing.assert_array_equal(moving.kept(points, planes, notch), expected)
            shift = random.normal(size=3)
            planes = [Plane(plane.normal, point=tuple(plane.point + shift)) for plane in planes]


@given(st.integers(0, 2**32 - 1), st.integers(1, MOST_PLANES), st.booleans())
def test_sections_are_the_faces_inside_the_mesh_that_a_cut_makes_visible(seed, count, along_axes):
    random, moving, skin = np.random.default_rng(seed), MovingPlanes(MESH), Skin(MESH)
    points, planes = scrambled(MESH, 0.3, seed).points, planes_of(random, count, along_axes)
    kept = moving.kept(points, planes, False)
    faces = skin.visible(kept)
    inside = skin.opened(faces, kept)
    expected = {(h, *nodes) for h, nodes in zip(faces.hexes[inside], faces.nodes[faces.quads[inside]], strict=True)}
    quads, hexes = moving.sections(points, planes)
    assert {(h, *nodes) for h, nodes in zip(hexes, quads, strict=True)} == expected


@pytest.mark.parametrize("cells", [0.5, 100])
def test_small_faces_become_squares_in_the_plane_and_large_ones_stay(cells):
    """A cell of 1/128 of the diagonal is larger or smaller than the faces."""
    plane, moving = Plane((0.0, 0.0, 1.0), point=(0.0, 0.0, 1.6)), MovingPlanes(MESH)
    quads, hexes = moving.sections(MESH.points, [plane])
    corners, owners = coarse_section(MESH.points, quads, hexes, [plane], diagonal=128 * 2 / cells)
    assert corners.shape == (4 * len(owners), 3)
    assert set(owners) <= set(hexes)
    if cells > 1:
        np.testing.assert_array_equal(corners, MESH.points[quads.ravel()])
        np.testing.assert_array_equal(owners, hexes)
        return
    np.testing.assert_allclose(corners[:, 2], 1.6)
    sides = np.linalg.norm(np.roll(corners.reshape(-1, 4, 3), -1, axis=1) - corners.reshape(-1, 4, 3), axis=2)
    np.testing.assert_allclose(sides, 4.0)
    assert len({tuple(place) for place in corners.reshape(-1, 4, 3).mean(axis=1).round(9)}) == len(owners)
