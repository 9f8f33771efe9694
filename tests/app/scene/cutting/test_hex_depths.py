"""Cuts by a sphere and by depth hide whole hexes."""

import numpy as np
import pytest

from hexmend.quality import measure
from hexmend_app.picture.appearance import Look
from hexmend_app.picture.cut import Cut
from hexmend_app.picture.cut_shapes import Depth, DepthUnit, Sphere
from hexmend_app.scene.geometry.filters import Filters
from hexmend_app.scene.views.frame import Frame
from tests.core.grids import grid, placed

MESH = grid(7, 6, 5)
CENTRES = MESH.points[MESH.hexes].mean(axis=1)
#: Distance of each centre from the nearest side of the body.
DISTANCE = np.minimum(CENTRES, [7, 6, 5] - CENTRES).min(axis=1)


def kept(cut, mesh=MESH, filters=None):
    frame = Frame(mesh, measure(mesh.points, mesh.hexes), look=Look(cut=cut))
    return (filters or Filters(mesh)).kept(frame)


@pytest.mark.parametrize("notch", [False, True])
def test_hexes_with_their_centre_in_the_sphere_stay(notch):
    inside = np.linalg.norm(CENTRES - (3, 3, 2), axis=1) <= 2.2
    np.testing.assert_array_equal(kept(Cut(sphere=Sphere((3, 3, 2), 2.2), notch=notch)), inside != notch)
    assert 0 < inside.sum() < len(inside)


@pytest.mark.parametrize(("low", "high"), [(1, 1), (2, 2), (2, 3), (0, 99), (4, 5)])
@pytest.mark.parametrize("notch", [False, True])
def test_layers_are_counted_from_the_boundary(low, high, notch):
    layer = np.floor(DISTANCE) + 1
    shown = (layer >= low) & (layer <= high)
    np.testing.assert_array_equal(kept(Cut(depth=Depth(low, high), notch=notch)), shown != notch)


@pytest.mark.parametrize("scale", [1.0, 0.001])
def test_distances_are_in_mean_edge_lengths(scale):
    mesh = MESH.with_points(MESH.points * scale)
    shown = kept(Cut(depth=Depth(0.9, 1.6, DepthUnit.EDGES)), mesh)
    np.testing.assert_array_equal(shown, (DISTANCE >= 0.9) & (DISTANCE <= 1.6))
    assert 0 < shown.sum() < len(shown)


def test_hexes_stay_while_nodes_move_and_follow_when_the_cut_changes():
    filters = Filters(MESH)
    cut = Cut(depth=Depth(0.0, 0.6, DepthUnit.EDGES))
    before = kept(cut, filters=filters)
    inner = MESH.free
    moved = placed(MESH, inner, 0.5 * (MESH.points[inner] + [3.5, 3, 2.5]))
    np.testing.assert_array_equal(kept(cut, moved, filters), before)
    wider = Cut(depth=Depth(0.0, 0.7, DepthUnit.EDGES))
    np.testing.assert_array_equal(kept(wider, moved, filters), kept(wider, moved))
