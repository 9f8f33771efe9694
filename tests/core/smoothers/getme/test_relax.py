"""Moves of GETMe that would invert a hex are halved, again and again, the fourth time to nothing."""

import numpy as np
import pytest

from hexmend.kernels import getme
from hexmend.quality import measure
from tests.core.grids import grid


def relaxed(moves):
    """A grid of unit cubes whose free nodes go by `moves`, shortened; how many were."""
    mesh = grid(2, 2, 3)
    free = np.flatnonzero(mesh.free)
    moved = mesh.points.copy()
    moved[free] += moves
    sound = ~measure(mesh.points, mesh.hexes).inverted
    harmed = np.flatnonzero(sound & measure(moved, mesh.hexes).inverted).astype(np.int32)
    count = getme.relax(mesh.points, mesh.topology.hex_mesh, sound, harmed, moved)
    return moved[free] - mesh.points[free], count, measure(moved, mesh.hexes).n_inverted


@pytest.mark.parametrize(
    ("far", "share"), [(0.9, 1.0), (1.5, 0.5), (3.0, 0.25), (6.0, 0.125), (12.0, 0.0), (-3.0, 0.25)]
)
@pytest.mark.parametrize("axis", [0, 1])
def test_a_move_is_halved_as_often_as_it_must_be(far, share, axis):
    moves = np.zeros((2, 3))
    moves[0, axis] = far
    there, count, inverted = relaxed(moves)
    np.testing.assert_allclose(there, share * moves)
    assert inverted == 0
    assert (count > 0) == (share < 1)
