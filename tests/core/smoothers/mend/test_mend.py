"""The default method: it untangles what can be untangled, and never makes a mesh worse."""

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend.gallery import make
from hexmend.io import read
from hexmend.iteration import Outcome
from hexmend.quality import corner_determinants, measure, summarise
from hexmend.run import StoppingCriteria, iterate, smooth
from hexmend.smoothers import METHODS
from tests.core.boundary.solids import wavy
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
