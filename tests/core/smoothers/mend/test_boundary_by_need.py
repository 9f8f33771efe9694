"""Boundary by need: nodes leave it where it keeps hexes inverted, only they, and a tolerance is a hard limit.

A boundary whose nodes move in space: which of them return exactly, and how far the others may be.
"""

from itertools import pairwise

import numpy as np
import pytest

from hexmend import smooth
from hexmend.boundary import NodeClass, SlidingBoundary
from hexmend.energy import ObjectiveNorm
from hexmend.energy.barriers.surface_fit import FitTolerances
from hexmend.gallery import make
from hexmend.io import read
from hexmend.mesh.cells import Cells
from hexmend.mesh.fixing import with_pinned
from hexmend.mesh.mesh import Mesh
from hexmend.run import StoppingCriteria
from hexmend.smoothers import METHODS
from hexmend.smoothers.mend.free_boundary import AUTO_FIT, FreeBoundary
from hexmend.smoothers.sliding_smoother import absolute_tolerance
from tests.core.boundary.solids import ball, cylinder, slid, wavy
from tests.core.grids import grid

Mend = METHODS["mend"]
SHORT = StoppingCriteria(max_iterations=200)


def chamfered(n=3):
    """Make a block one of whose edges is cut off: there each hex has two faces on one flat piece of the boundary."""
    mesh = grid(n)
    points, (x, _, z) = mesh.points.copy(), mesh.points.T
    edge = np.flatnonzero((x == 0) & (z == n))
    points[edge] += [0.52, 0, -0.52]
    return mesh.with_points(points), edge


@pytest.mark.parametrize("goal", ["shape", "scaled-jacobian"])
def test_nodes_that_hold_hexes_inverted_leave_the_boundary_and_those_around_hardly(goal):
    mesh, edge = chamfered()
    fixed = smooth(mesh, Mend(goal=goal))
    result = smooth(mesh, Mend(goal=goal, boundary="slide"))
    assert (fixed.after.inverted, result.after.inverted) == (3, 0)
    distances = result.departures.distance / mesh.mean_edge_length
    assert result.departures.nodes.size > 0
    around = np.union1d(edge, mesh.topology.rings.of(edge))
    assert np.isin(distances.argmax(), around)
    assert np.count_nonzero(distances > AUTO_FIT) <= around.size
    assert "nodes have left" in result.surface_sentence or "node has left" in result.surface_sentence


def test_a_tolerance_of_0_and_pins_hold_whatever_it_costs():
    mesh, edge = chamfered()
    for case in (
        smooth(mesh, Mend(boundary="slide", surface_tolerance=0), SHORT),
        smooth(with_pinned(mesh, edge), Mend(boundary="slide"), SHORT),
    ):
        assert not np.isin(case.departures.nodes, edge).any()
    np.testing.assert_array_equal(case.mesh.points[edge], mesh.points[edge])


@pytest.mark.parametrize("tolerance", [0.1, "2%"])
def test_a_tolerance_that_is_given_is_a_hard_limit(tolerance):
    mesh, _ = chamfered()
    result = smooth(mesh, Mend(goal="scaled-jacobian", boundary="slide", surface_tolerance=tolerance), SHORT)
    limit = absolute_tolerance(mesh, tolerance) / mesh.mean_edge_length
    assert result.surface.max <= limit * (1 + 1e-4)


@pytest.mark.slow
def test_where_pins_hold_hexes_inverted_a_small_tolerance_ends_no_worse():
    mesh, edge = chamfered(6)
    mesh = with_pinned(mesh, edge[:3])
    result = smooth(mesh, Mend(goal="scaled-jacobian", boundary="slide", surface_tolerance=0.2), SHORT)
    assert result.after.inverted < result.before.inverted
    assert result.surface.max <= 0.2 * (1 + 1e-4)


def test_a_tolerance_in_per_cent_is_that_of_the_diagonal():
    mesh = grid(3, 4, 12)
    assert absolute_tolerance(mesh, "10%") == pytest.approx(1.3)
    assert absolute_tolerance(mesh, 0.5) == pytest.approx(0.5)
    assert absolute_tolerance(mesh, "unlimited") == np.inf


SMALL = {
    "ball": lambda: slid(ball(4), 0.5, 3),
    "cylinder": lambda: slid(cylinder(16, 3), 0.5, 3),
    "block": lambda: slid(grid(4), 0.6, 3),
    "bridge-sharp": lambda: make("bridge-sharp", size=60),
    "five-side": lambda: make("five-side", size=100),
}


def check_freedom(mesh):
    """Check that the least is no lower with the boundary sliding than fixed."""
    fixed, slides = (smooth(mesh, Mend(goal="scaled-jacobian", boundary=boundary)) for boundary in ("fixed", "slide"))
    assert slides.after.inverted <= fixed.after.inverted
    if not fixed.after.inverted:
        assert slides.after.scaled_jacobian_min >= fixed.after.scaled_jacobian_min - 1e-9


@pytest.mark.slow
@pytest.mark.parametrize("name", ["five-side", "ball", "block"])
def test_a_boundary_that_slides_ends_no_lower_than_a_fixed_one(name):
    check_freedom(SMALL[name]())


@pytest.mark.slow
def test_a_real_boundary_that_slides_ends_no_lower_than_a_fixed_one(real_mesh):
    check_freedom(read(real_mesh("mid2FemPer.vtk")))


def perturbed(mesh, seed):
    """Return a mesh whose coordinates differ from those of another by rounding."""
    factors = 1 + 1e-12 * np.random.default_rng(seed).uniform(-1, 1, mesh.points.shape)
    return mesh.with_points(mesh.points * factors)


@pytest.mark.slow
def test_rounding_does_not_choose_whether_a_ball_is_untangled():
    mesh = SMALL["ball"]()
    meshes = [mesh, *(perturbed(mesh, seed) for seed in (1, 3))]
    ends = [smooth(each, Mend(goal="scaled-jacobian", boundary="slide")) for each in meshes]
    assert [end.after.inverted for end in ends] == [0, 0, 0]
    assert min(end.after.scaled_jacobian_min for end in ends) > 0.4


@pytest.mark.slow
def test_rounding_does_not_choose_the_quality_of_a_real_boundary(real_mesh):
    result = smooth(perturbed(read(real_mesh("bunny.vtk")), 2), Mend(boundary="slide"))
    assert result.after.inverted == 0
    assert result.after.scaled_jacobian_min > 0.25
    assert result.after.q_min > 0.4
    assert result.after.q_mean > 0.86


@pytest.mark.slow
def test_the_floors_rise_where_nodes_have_left_too():
    mesh, _ = chamfered()
    shape, balanced = (smooth(mesh, Mend(goal=goal, boundary="slide")) for goal in ("shape", "balanced"))
    assert balanced.departures.nodes.size > 0
    assert balanced.after.scaled_jacobian_min > shape.after.scaled_jacobian_min + 0.01
    assert "The minimum scaled Jacobian of the corners that can be moved reached" in balanced.message


def check_tolerances(mesh, tolerances):
    """Check that the least is no lower with a larger tolerance."""
    ends = [
        smooth(mesh, Mend(goal="scaled-jacobian", boundary="slide", surface_tolerance=tolerance)).after
        for tolerance in tolerances
    ]
    least = [end.scaled_jacobian_min for end in ends]
    assert all(after >= before - 1e-9 for before, after in pairwise(least)), least
    assert all(after.inverted <= before.inverted for before, after in pairwise(ends))
    assert ends[-1].inverted == 0


@pytest.mark.slow
@pytest.mark.parametrize("name", ["cylinder", "five-side"])
def test_a_larger_tolerance_ends_no_lower(name):
    check_tolerances(SMALL[name](), (0.0, 0.1, 1.0))


@pytest.mark.slow
def test_a_larger_tolerance_of_a_real_boundary_ends_no_lower(real_mesh):
    check_tolerances(read(real_mesh("block_in.mesh")), (0.0, 0.1, 1.0))


def knob():
    """A grid with a hex on the centre of a face; one of its outer nodes is below that face."""
    mesh = grid(3, 3, 2)
    on_face = [int(np.flatnonzero((mesh.points == place).all(axis=1))[0]) for place in
               ((1, 1, 2), (2, 1, 2), (2, 2, 2), (1, 2, 2))]  # fmt: skip
    above = mesh.points[on_face] + [0, 0, 1]
    above[2] = 2, 2, 1.8
    top = mesh.n_nodes + np.arange(4)
    return Mesh(np.vstack([mesh.points, above]), np.vstack([mesh.hexes, [*on_face, *top]]))


@pytest.mark.slow
def test_a_result_with_an_inverted_hex_is_no_better_than_one_without():
    """Within smaller tolerances the hex stays inverted, and the least of the corners that can be moved is 1."""
    settings = {"goal": "scaled-jacobian", "boundary": "slide", "surface_tolerance": 0.3, "keep_last": True}
    result = smooth(knob(), "mend", **settings)
    assert result.after.inverted == 0
    assert result.after.scaled_jacobian_min > 0.95


@pytest.mark.slow
def test_nodes_may_leave_a_surface_without_a_limit_of_the_distance():
    mesh = SMALL["ball"]()
    result = smooth(mesh, Mend(goal="scaled-jacobian", boundary="slide", surface_tolerance="unlimited"))
    assert result.before.inverted
    assert result.after.inverted == 0


def test_edges_between_sets_are_left_only_with_a_tolerance_in_numbers():
    mesh = grid(4)
    quads = mesh.topology.boundary_faces
    low = mesh.points[quads][:, :, 2].max(axis=1) <= 2  # the lower half of the sides and the bottom
    mesh = mesh.replace(cells=(Cells("quad", quads, {"medit:ref": np.where(low, 1, 2)}),))
    between = (mesh.points[:, 2] == 2) & mesh.topology.boundary
    holding, released = (SlidingBoundary(mesh, sets_hold=hold) for hold in (True, False))
    assert (holding.node_class[between] <= NodeClass.CURVE).all()
    assert not holding.leavable[between].any()
    assert released.leavable[between & ~released.mesh.fixed].all()
    np.testing.assert_array_equal(holding.node_class, released.node_class)


@pytest.mark.parametrize("settings", [{}, {"surface_tolerance": 0.0}, {"goal": "shape"}, {"goal": "balanced"}])
def test_a_hex_with_two_faces_on_a_flat_patch_is_mended_off_the_surface_only(settings):
    """The corner of a block is cut off, so that a hex has two faces on one flat patch."""
    mesh = grid(3)
    edge = (mesh.points[:, 0] == 0) & (mesh.points[:, 1] == 0)
    points = np.where(edge[:, None], mesh.points + [0.5, 0.5, 0], mesh.points)
    result = smooth(mesh.with_points(points), Mend(**{"goal": "scaled-jacobian", "boundary": "slide"} | settings))
    assert (result.after.inverted == 0) == (settings.get("surface_tolerance") != 0.0)


@pytest.mark.slow
def test_hexes_that_untangling_leaves_inverted_are_raised_from_where_the_fewest_are(real_mesh):
    result = smooth(read(real_mesh("dragon_in.mesh")), Mend(goal="scaled-jacobian", boundary="slide"))
    assert result.after.inverted == 0
    assert result.after.scaled_jacobian_min > 0.1


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
