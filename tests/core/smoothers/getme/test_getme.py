"""GETMe: its element step against the definition, and what both stages promise.

Moves of GETMe that would invert a hex are halved, again and again, the fourth time to nothing.
"""

import itertools

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from hexmend import METHODS, Outcome, StoppingCriteria, gallery, measure, smooth
from hexmend.kernels import getme
from hexmend.kernels.element_step import element_steps
from hexmend.mesh.hexahedron import EDGES, UNIT_CUBE
from hexmend.smoothers.base import figures_of_merit
from hexmend.smoothers.getme.sequential import HALVINGS
from tests.core.grids import grid, scrambled

ONE = np.arange(8, dtype=np.int32)[None]
STAGES = ["getme", "getme-sequential"]


def stepped(x, s=1.0, rho=1.0):
    """One element step of a hex by the kernel."""
    places = np.empty((1, 8, 3))
    element_steps(np.ascontiguousarray(x), ONE, s, rho, places)
    return places[0]


def by_definition(x, s, rho):
    """The same from its definition: faces are corners that share a coordinate of the unit cube."""
    towards = 2 * UNIT_CUBE - 1
    y = np.empty((8, 3))
    for k in range(8):
        faces = [x[UNIT_CUBE[:, axis] == UNIT_CUBE[k, axis]].mean(axis=0) for axis in range(3)]
        n = np.cross(faces[1] - faces[0], faces[2] - faces[0]) * towards[k].prod()
        y[k] = np.mean(faces, axis=0) + s * n / np.sqrt(np.linalg.norm(n))
    length = [np.linalg.norm(z[EDGES[:, 0]] - z[EDGES[:, 1]], axis=1).mean() for z in (x, y)]
    y = y.mean(axis=0) + length[0] / length[1] * (y - y.mean(axis=0))
    return x + rho * (y - x)


hexes = st.integers(0, 2**32 - 1).map(lambda seed: UNIT_CUBE + np.random.default_rng(seed).normal(0, 0.4, (8, 3)))


@given(hexes, st.floats(0.1, 3), st.floats(0.01, 1))
def test_the_element_step_is_its_definition_on_any_hex(x, s, rho):
    np.testing.assert_allclose(stepped(x, s, rho), by_definition(x, s, rho), atol=1e-9)


@given(st.floats(1e-3, 1e3), st.integers(0, 2**32 - 1), st.floats(0.1, 3))
def test_a_cube_of_any_size_and_place_is_a_fixed_point(size, seed, s):
    random = np.random.default_rng(seed)
    cube = size * (Rotation.random(rng=random).apply(UNIT_CUBE) + random.uniform(-1, 1, 3))
    np.testing.assert_allclose(stepped(cube, s), cube, atol=1e-12 * size)


def test_degenerate_hexes_give_finite_places():
    for x in (np.zeros((8, 3)), UNIT_CUBE * [1, 1, 0], UNIT_CUBE * [1, 1, -1]):
        assert np.isfinite(stepped(x)).all()


@pytest.mark.parametrize("name", STAGES)
@given(seed=st.integers(0, 2**32 - 1), amplitude=st.floats(0.1, 1.2))
def test_no_sound_hex_is_ever_inverted(name, seed, amplitude):
    mesh = scrambled(grid(4), amplitude, seed)
    inverted = measure(mesh.points, mesh.hexes).inverted
    for step in itertools.islice(METHODS[name]().steps(mesh), 8):
        now = measure(step.points, mesh.hexes).inverted
        assert not (now & ~inverted).any()
        inverted = now


@pytest.mark.parametrize("name", STAGES)
@pytest.mark.parametrize("amplitude", [0.3, 0.9])
def test_figures_that_come_with_a_step_are_those_of_its_points(name, amplitude):
    mesh = scrambled(grid(4), amplitude)
    steps = list(itertools.islice(METHODS[name]().steps(mesh), 1, 6))
    for step in steps:
        np.testing.assert_array_equal(step.quality.q, measure(step.points, mesh.hexes).q)
    assert steps


@pytest.mark.parametrize("weights", ["quality", "paper", "equal"])
def test_simultaneous_ends_by_itself_and_untangles_a_scrambled_grid(weights):
    mesh = scrambled(grid(6), 0.6, 3)
    assert measure(mesh.points, mesh.hexes).n_inverted > 20
    result = smooth(mesh, METHODS["getme"](weights=weights), StoppingCriteria(max_iterations=2000, tolerance=0))
    assert result.outcome is Outcome.NO_IMPROVEMENT
    assert result.after.inverted == 0
    assert result.after.q_mean > 0.99


@given(seed=st.integers(0, 2**32 - 1), amplitude=st.floats(0.05, 0.45))
def test_sequential_never_lowers_q_min_of_a_valid_mesh(seed, amplitude):
    mesh = scrambled(grid(4), amplitude, seed)
    assume(measure(mesh.points, mesh.hexes).n_inverted == 0)
    least = [step.quality.q.min() for step in itertools.islice(METHODS["getme-sequential"]().steps(mesh), 1, 12)]
    least.insert(0, measure(mesh.points, mesh.hexes).q.min())
    assert (np.diff(least) >= 0).all()
    assert least[-1] > least[0]


@pytest.mark.parametrize("mesh", [("five-side", 920), ("bridge-sharp", 500)], ids=lambda m: m[0])
def test_the_second_stage_raises_q_min_over_the_first(mesh):
    first = smooth(gallery.make(mesh[0], size=mesh[1]), "getme")
    second = smooth(first.mesh, "getme-sequential")
    assert second.outcome is Outcome.NO_IMPROVEMENT
    assert second.after.q_min > first.after.q_min + 0.002


# When GETMe ends, with what weights it begins, and by what its steps are shortened: numbers that are known.


GETMe, Sequential = METHODS["getme"], METHODS["getme-sequential"]


@pytest.mark.parametrize("patience", [1, 2, 5])
def test_a_grid_of_cubes_ends_after_so_many_iterations_without_a_rise(patience):
    assert len(list(GETMe(patience=patience).steps(grid(3)))) == 1 + patience


def test_what_is_to_rise_are_inverted_hexes_with_a_minus_and_the_least_and_mean_quality():
    figures = measure(*(getattr(scrambled(grid(3), 1.0, 2), name) for name in ("points", "hexes")))
    assert figures.n_inverted > 0
    assert figures_of_merit(figures).tolist() == [-figures.n_inverted, figures.q.min(), figures.q.mean()]


def test_weights_are_their_formulas():
    q = np.array([0.0, 0.005, 0.25, 1.0])
    np.testing.assert_allclose(GETMe().hex_weights(q), [10, 10, 2, 1])
    np.testing.assert_allclose(GETMe(weights="paper", exponent=4.0).hex_weights(q), [1, 0.995**2, 0.75**2, 1e-24])
    np.testing.assert_allclose(GETMe(weights="paper", exponent=0.0).hex_weights(q), np.ones(4))
    for exponent in (1.0, 3.0):
        weights = GETMe(weights="paper", exponent=exponent).hex_weights(q)
        np.testing.assert_allclose(weights[:3], (1 - q[:3]) ** (exponent / 2))
        assert weights[3] > 0  # never nothing
    assert GETMe(weights="equal").hex_weights(q).tolist() == [1, 1, 1, 1]


def test_sequential_halves_its_share_after_each_sweep_without_a_rise_and_then_ends():
    steps = list(Sequential(relaxation=0.2).steps(grid(3)))[1:]
    assert [step.diagnostics["relaxation"] for step in steps] == [0.2 / 2**k for k in range(HALVINGS + 1)]
    assert all(step.intermediate for step in steps)


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
