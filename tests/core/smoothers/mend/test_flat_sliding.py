"""Mend on solids with flat faces: sliding nodes stay in plane exactly, and the optimum is reached exactly."""

import numpy as np
import pytest
from scipy.stats import special_ortho_group

import hexmend as hx
from hexmend.boundary import SlidingBoundary
from hexmend.gallery import make
from hexmend.mesh.mesh import Mesh
from tests.core.grids import grid
from tests.core.linear_motions import planes

SOLIDS = {
    "cube": lambda x: np.zeros(len(x), dtype=bool),
    "L": lambda x: (x[:, 0] > 3) & (x[:, 1] > 3),
    "hole": lambda x: (np.abs(x[:, 0] - 3) < 1) & (np.abs(x[:, 1] - 3) < 1),
    "notch": lambda x: (np.abs(x[:, 0] - 3) < 1) & (x[:, 1] > 3) & (x[:, 2] > 3),
}


def solid(name, turned):
    """A part of a grid of 6^3 cubes, turned so that no face is along an axis if that is asked for."""
    whole = grid(6)
    hexes = whole.hexes[~SOLIDS[name](whole.points[whole.hexes].mean(axis=1))]
    used, hexes = np.unique(hexes, return_inverse=True)
    points = whole.points[used]
    if turned:
        points = points @ special_ortho_group.rvs(3, random_state=1).T + 10.0
    return Mesh(points, hexes.reshape(-1, 8).astype(np.int32))


@pytest.mark.parametrize(("name", "turned"), [("cube", False), ("L", True), ("hole", False), ("notch", True)])
def test_a_solid_scrambled_within_its_faces_becomes_the_lattice_again(name, turned):
    given = solid(name, turned)
    sliding = SlidingBoundary(given)
    shift = np.random.default_rng(1).uniform(-0.4, 0.4, given.points.shape) * sliding.mesh.free[:, None]
    scrambled = given.keeping_surface().with_points(sliding.linear_mesh.constrained(given.points + shift))
    result = hx.smooth(scrambled, "mend", boundary="slide")
    assert result.before.inverted > 0
    assert result.after.inverted == 0
    points = result.mesh.points
    assert np.abs(points - given.points).max() < 1e-6
    off = np.abs(points[sliding.nodes] - sliding.project(points[sliding.nodes])).max()
    assert off <= (1e-14 if turned else 0.0)


@pytest.mark.parametrize(("how", "scale"), [("slide", [1.0, 0.5, 0.2]), ("planes", [1.0, 1.0, 1.0])])
def test_kershaws_map_ends_at_the_uniform_lattice(how, scale):
    kershaw = make("kershaw", size=216)
    mesh = kershaw.with_points(kershaw.points * scale)
    if how == "slide":
        result = hx.smooth(mesh, "mend", boundary="slide", target="ideal")
    else:
        result = hx.smooth(mesh.with_linear_motion(planes(mesh)), "mend", target="ideal")
    lattice = np.rint(grid(6).points) / 6 * scale
    order = np.lexsort(lattice.T)
    points = result.mesh.points[np.lexsort(np.rint(result.mesh.points / scale * 6).T)]
    assert np.abs(points - lattice[order]).max() < 1e-6


def test_sliding_raises_the_least_where_no_corner_can_be_moved_with_the_boundary_fixed():
    mesh = grid(4, 1, 1)
    points = mesh.points.copy()
    points[(points[:, 0] == 2) & (points[:, 1] == 0), 0] += 0.7
    result = hx.smooth(mesh.with_points(points), "mend", goal="scaled-jacobian", boundary="slide")
    assert result.before.scaled_jacobian_min < 0.9
    assert result.after.scaled_jacobian_min > 0.999
