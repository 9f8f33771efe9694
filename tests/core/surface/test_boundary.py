"""Kinds of nodes: on solids whose corners, curves and patches are known, and what holds on every mesh."""

import numpy as np
import pytest

from hexmend.mesh import Mesh
from hexmend.surface import Kind, boundary_of
from tests.core.grids import grid


def counts(boundary):
    return [boundary.count(kind) for kind in (Kind.CORNER, Kind.CURVE, Kind.PATCH)]


def cylinder(around=32, layers=5):
    """A square block whose sides are blown up to a circle of 4 * n sides, extruded."""
    n = around // 4
    mesh = grid(n, n, layers)
    x = 2 * mesh.points[:, :2] / n - 1
    size, far = np.abs(x).max(axis=1), np.linalg.norm(x, axis=1)
    angle = np.pi / 4 * np.where(np.abs(x[:, 0]) >= np.abs(x[:, 1]), x[:, 1], x[:, 0]) / np.where(size > 0, size, 1)
    wide = np.abs(x[:, 0]) >= np.abs(x[:, 1])
    sign = np.sign(np.where(wide, x[:, 0], x[:, 1]))
    round_x = np.where(wide, sign * np.cos(angle), np.sin(angle)) * size
    round_y = np.where(wide, np.sin(angle), sign * np.cos(angle)) * size
    assert far.max() > 1
    return Mesh(np.column_stack([round_x, round_y, mesh.points[:, 2] / layers]), mesh.hexes)


@pytest.mark.parametrize(("nx", "ny", "nz"), [(1, 1, 1), (4, 4, 4), (5, 3, 2)])
def test_a_box_has_eight_corners_twelve_curves_and_six_patches(nx, ny, nz):
    boundary = boundary_of(grid(nx, ny, nz))
    inner = [nx - 1, ny - 1, nz - 1]
    on_patches = 2 * (inner[0] * inner[1] + inner[1] * inner[2] + inner[2] * inner[0])
    assert counts(boundary) == [8, 4 * sum(inner), on_patches]
    assert (boundary.n_curves, boundary.n_patches) == (12, 6)
    assert len(boundary.segments) == 4 * (nx + ny + nz)


def test_a_cylinder_has_two_loops_without_a_corner_and_three_patches():
    boundary = boundary_of(cylinder(32, 5))
    assert counts(boundary)[:2] == [0, 64]
    assert (boundary.n_curves, boundary.n_patches) == (2, 3)
    assert np.bincount(boundary.curve_of_segment).tolist() == [32, 32]
