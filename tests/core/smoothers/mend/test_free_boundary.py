"""A boundary whose nodes move in space: which of them return exactly, and how far the others may be."""

import numpy as np
import pytest

from hexmend import smooth
from hexmend.boundary import SlidingBoundary
from hexmend.energy import ObjectiveNorm
from hexmend.energy.barriers.surface_fit import FitTolerances
from hexmend.gallery import make
from hexmend.smoothers import METHODS
from hexmend.smoothers.mend.free_boundary import FreeBoundary
from tests.core.boundary.solids import ball, cylinder, slid, wavy
from tests.core.grids import grid

GIVEN = {
    "cylinder": lambda: slid(cylinder(16, 2), 0.2, 0),
    "ball": lambda: slid(ball(3), 0.2, 0),
    "wavy": lambda: wavy(grid(4), 0.15, 2),
}


@pytest.mark.parametrize("goal", ["balanced", "scaled-jacobian"])
@pytest.mark.parametrize("name", sorted(GIVEN))
def test_a_tolerance_in_numbers_is_kept_where_only_some_nodes_return(name, goal):
    result = smooth(GIVEN[name](), METHODS["mend"](goal=goal, boundary="slide", surface_tolerance=0.02))
    assert result.surface.max <= 0.02


def test_nodes_that_return_stay_where_they_are_in_the_units_of_the_mesh():
    """Patches are flat or curved as a whole, not by the faces whose nodes have returned."""
    mesh = make("bridge-sharp", size=108, scramble=0.05, seed=0)
    tolerances = FitTolerances(0.07, 0.07, 0.01)
    free = FreeBoundary(SlidingBoundary(mesh), np.zeros(mesh.n_hexes, bool), tolerances, ObjectiveNorm(1.0))
    shift = np.random.default_rng(0).uniform(-0.02, 0.02, mesh.points.shape) * free.free[:, None]
    exact, found = free.returned(mesh.points + shift * mesh.mean_edge_length, 0.01, 0.01)
    again = exact.energy.to_mesh_units(exact.energy.to_edge_units(found))
    np.testing.assert_allclose(again, found, atol=1e-12 * mesh.mean_edge_length)
    assert exact.free.sum() < free.free.sum()


def test_corners_stay_without_a_limit():
    mesh = slid(cylinder(16, 2), 0.2, 0)
    result = smooth(mesh, METHODS["mend"](boundary="slide", surface_tolerance="unlimited"))
    corners = SlidingBoundary(mesh).mesh.fixed
    np.testing.assert_array_equal(result.mesh.points[corners], mesh.points[corners])
