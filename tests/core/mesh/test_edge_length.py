"""Mean edge length: every edge counts once a hex, and a distant node does not distort it."""

import numpy as np
import pytest

from hexmend.mesh.edge_length import OUTLIER_FACTOR, mean_edge_length
from tests.core.grids import grid


def test_each_edge_counts_once_a_hex():
    mesh = grid(3)
    assert mesh.mean_edge_length == mean_edge_length(mesh.points, mesh.hexes) == pytest.approx(1)
    assert mesh.with_points(mesh.points * [1, 2, 3]).mean_edge_length == pytest.approx(2)


@pytest.mark.parametrize("far", [1e6, 1e150])
def test_one_node_far_away_spoils_nothing(far):
    mesh = grid(4)
    points = mesh.points.copy()
    points[np.flatnonzero(mesh.free)[0]] = far
    assert 0.9 < mean_edge_length(points, mesh.hexes) < OUTLIER_FACTOR
