"""The default method: it untangles what can be untangled, and never makes a mesh worse.

Mend whose boundary slides: how far it may leave the surface, and what flat solids keep.
"""

import itertools

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.stats import special_ortho_group

from hexmend.boundary import SlidingBoundary, surface_change
from hexmend.gallery import make
from hexmend.io import read
from hexmend.iteration import Outcome
from hexmend.quality import corner_determinants, measure, summarise
from hexmend.run import StoppingCriteria, iterate, smooth
from hexmend.smoothers import METHODS
from hexmend.smoothers.mend.free_boundary import AUTO_FIT, RETURN
from tests.core.boundary.solids import ball, cylinder, slid, wavy
from tests.core.grids import grid, scrambled

Mend = METHODS["mend"]
SHAPE = Mend(goal="shape")


def with_locked_corner(mesh):
    """The mesh with its first node pushed so far in that the corner tetrahedron there, all fixed, is inverted."""
    points = mesh.points.copy()
    points[0] += 0.7 * (points[mesh.hexes[0, 6]] - points[0])
    return mesh.with_points(points)


@given(st.integers(0, 2**32 - 1))
def test_corner_determinants_are_those_that_measure_judges_by(seed):
    mesh = scrambled(grid(3), 0.9, seed)
    points = mesh.points.round(1)  # some corners exactly flat
    np.testing.assert_array_equal(
        corner_determinants(points, mesh.hexes).min(axis=1), measure(points, mesh.hexes).sigma
    )


@pytest.mark.parametrize(
    ("name", "size", "scramble"),
    [("cube", 216, 1.5), ("five-side", 300, 5.0), ("bridge-sharp", 500, 0.6), ("plane", 900, 1.5)],
)
def test_scrambled_gallery_meshes_end_untangled_at_the_optimum(name, size, scramble):
    sound = smooth(make(name, size=size), SHAPE)
    tangled = make(name, size=size, scramble=scramble, seed=7)
    assert measure(tangled.points, tangled.hexes).n_inverted > 20
    result = smooth(tangled, SHAPE, StoppingCriteria(max_iterations=1000))
    assert result.outcome is Outcome.CONVERGED
    assert result.after.inverted == 0
    assert result.after.objective == pytest.approx(sound.after.objective, rel=1e-5, abs=1e-9)


@pytest.mark.parametrize("how", [{}, {"boundary": "slide"}, {"goal": "shape"}], ids=str)
@pytest.mark.parametrize(("p", "offset", "scramble"), [(1.0, 0.0, 0.3), (2.0, 1.0, 0.0), (4.0, 1.0, 0.3)])
def test_a_mesh_of_cubes_ends_as_converged(p, offset, how, scramble):
    result = smooth(make("cube", size=27, scramble=scramble), Mend(p=p, offset=offset, **how))
    assert result.outcome is Outcome.CONVERGED
    assert result.after.q_min == pytest.approx(1, abs=1e-4)  # with a high p, cubes are where the energy is very flat


@given(
    seed=st.integers(0, 2**32 - 1),
    amplitude=st.floats(0.05, 4),
    iterations=st.integers(0, 12),
    p=st.sampled_from([1.0, 2.0, 4.0]),
)
def test_wherever_it_is_stopped_the_mesh_is_no_worse(seed, amplitude, iterations, p):
    mesh = scrambled(grid(4), amplitude, seed)
    result = smooth(mesh, Mend(goal="shape", p=p), StoppingCriteria(max_iterations=iterations))
    before, after = (measure(one.points, mesh.hexes) for one in (mesh, result.mesh))
    assert after.n_inverted <= before.n_inverted
    assert result.after.inverted == after.n_inverted
    if after.n_inverted == before.n_inverted == 0:
        assert (after.eta**p).sum() <= (before.eta**p).sum()


@pytest.mark.parametrize("scramble", [0.0, 1.5])
def test_what_fixed_nodes_lock_is_left_out_and_said_and_spoils_nothing_else(scramble):
    mesh = make("five-side", size=300, scramble=scramble, seed=3)
    rest = smooth(mesh, "mend").after
    locked = with_locked_corner(mesh)
    assert summarise(locked).locked_inverted == 1
    result = smooth(locked, "mend")
    assert result.after.inverted == result.after.locked_inverted == 1
    assert "Left out of the energy: 1 hex has corners that fixed nodes keep inverted." in result.message
    q = measure(result.mesh.points, mesh.hexes).q
    assert np.sort(q)[10] > rest.q_min  # all but the hexes around it are as good as without


def test_steps_of_untangling_soften_the_barrier_less_and_less():
    mesh = make("cube", size=512, scramble=1.5, seed=2)
    deltas = [it.diagnostics["delta"] for it in iterate(mesh, "mend")]
    assert deltas[0] > 0.05
    assert deltas[-1] == 0
    hard = deltas.index(0)
    assert hard > 1
    assert all(delta > 0 for delta in deltas[:hard])
    assert all(delta == 0 for delta in deltas[hard:])


def test_higher_p_lifts_the_worst_hex():
    mesh = make("bridge-sharp", size=864)
    plain, raised = (smooth(mesh, Mend(goal="shape", p=p), StoppingCriteria(max_iterations=500)) for p in (2.0, 16.0))
    assert raised.outcome is Outcome.CONVERGED
    assert raised.after.q_min > plain.after.q_min + 0.01
    assert raised.after.q_mean < plain.after.q_mean


def test_a_run_at_its_optimum_has_no_iteration_that_only_repeats_the_last():
    steps = list(itertools.islice(METHODS["mend"](goal="shape").steps(wavy(grid(3), 0.2)), 300))
    assert 2 < len(steps) < 300
    assert all((one.points != other.points).any() for one, other in itertools.pairwise(steps))


@pytest.mark.parametrize(
    "name",
    ["hex_5_tangled.vtk", *(pytest.param(name, marks=pytest.mark.slow) for name in ("CAD4Per.vtk", "bunny.vtk"))],
)
def test_real_meshes_end_at_the_lower_bound(name, real_mesh):
    result = smooth(read(real_mesh(name)), "mend")
    assert result.after.inverted == result.after.locked_inverted


@pytest.mark.slow
def test_hexes_of_very_different_sizes_reach_their_optimum(real_mesh):
    """The small ones move by many of their edges: without damping limits of steps end the run at an objective of 13."""
    result = smooth(read(real_mesh("sphere_r9.msh")), SHAPE)
    assert result.outcome is Outcome.CONVERGED
    assert result.after.objective < 10.2
    assert result.iterations < 100


SHORT = StoppingCriteria(max_iterations=80)
seeds = st.integers(0, 2**32 - 1)
goals = st.sampled_from(["shape", "scaled-jacobian"])

FLAT = {
    "block": lambda: grid(3, 2, 4),
    "cube": lambda: grid(3),
    "bridge-sharp": lambda: make("bridge-sharp", size=60),
}
BENT = {"cylinder": lambda: cylinder(16, 2), "ball": lambda: ball(3), "wavy": lambda: wavy(grid(3), 0.25)}
SOLIDS = FLAT | BENT


def turned(mesh, seed):
    """The mesh, turned and shifted at random, so that no side is along an axis."""
    random = np.random.default_rng(seed)
    return mesh.with_points(mesh.points @ special_ortho_group.rvs(3, random_state=random).T + random.normal(size=3))


@pytest.mark.slow
@settings(max_examples=12)
@given(st.sampled_from(sorted(FLAT)), goals, st.floats(0, 0.3), st.sampled_from([0.0, 0.3, "unlimited"]), seeds)
@pytest.mark.slow
def test_flat_solids_keep_surface_and_volume(solid, goal, amplitude, tolerance, seed):
    mesh = turned(slid(FLAT[solid](), amplitude, seed), seed)
    result = smooth(mesh, Mend(goal=goal, boundary="slide", surface_tolerance=tolerance), SHORT)
    if tolerance:
        assume(not result.departures.nodes.size)  # sliding was enough
    assert result.surface.max < 1e-12
    assert abs(result.surface.volume_change) < 1e-12
    assert result.surface.features_kept == result.surface.features


@settings(max_examples=12)
@given(st.sampled_from(sorted(SOLIDS)), goals, st.floats(0, 0.6), seeds)
@pytest.mark.slow
def test_without_a_limit_nodes_stay_on_their_curves_and_patches(solid, goal, amplitude, seed):
    mesh = slid(SOLIDS[solid](), amplitude, seed)
    sliding = SlidingBoundary(mesh)
    result = smooth(mesh, Mend(goal=goal, boundary="slide", surface_tolerance="unlimited"), SHORT)
    assume(not result.departures.nodes.size)  # none had to leave
    on = result.mesh.points[sliding.nodes]
    away = np.linalg.norm(sliding.project(on) - on, axis=1)
    assert away.max() < 1e-9 * mesh.mean_edge_length
    kept = sliding.mesh.fixed
    np.testing.assert_array_equal(result.mesh.points[kept], mesh.points[kept])


@pytest.mark.parametrize("name", ["block_in.mesh"])
@pytest.mark.slow
def test_a_real_mesh_is_freed_within_its_tolerance(name, real_mesh):
    mesh = read(real_mesh(name))
    assert measure(mesh.points, mesh.hexes).n_inverted > 0
    result = smooth(mesh, Mend(goal="scaled-jacobian", boundary="slide"))
    assert result.after.inverted == 0
    assert result.after.scaled_jacobian_min > 0.25
    assert result.surface.max <= 0.3 * (1 + 1e-4)


def rough(seed):
    """A cube whose boundary is crumpled, so that nodes have to leave it."""
    mesh = make("cube", size=27)
    points, crumpled = mesh.points.copy(), mesh.topology.boundary
    noise = np.random.default_rng(seed).normal(size=(int(crumpled.sum()), 3))
    points[crumpled] += 0.33 * mesh.mean_edge_length * noise
    return mesh.with_points(points)


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.slow
def test_to_its_end_it_turns_no_quad_over_and_speaks_of_what_it_keeps(seed):
    mesh = rough(seed)
    result = smooth(mesh, Mend(boundary="slide", goal="scaled-jacobian"), StoppingCriteria(max_iterations=600))
    assert result.after.inverted <= result.before.inverted
    assert not SlidingBoundary(mesh).flipped_quads(mesh.points, result.mesh.points).size
    assert surface_change(mesh, result.mesh).max <= RETURN.wider[-1] * AUTO_FIT
    assert result.active is None or result.kept == result.iterations
    assert ("hold each other" in result.message) <= (result.kept == result.iterations)
    assert not (result.after.inverted and "rises instead" in result.message)
