"""What holds for every registered method: the tests run over the registry, and a new method is in them at once."""

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.stats import special_ortho_group

from hexmend import METHODS, gallery, measure
from hexmend.parameters import declared, from_strings
from tests.core.grids import grid, scrambled
from tests.core.threads import by_threads

pytestmark = pytest.mark.parametrize("name", METHODS)


def points_after(mesh, smoother, steps):
    return [step.points for step in itertools.islice(smoother.steps(mesh), steps + 1)]


def test_fixed_nodes_stay_bitwise_and_the_input_is_untouched(name):
    mesh = scrambled(grid(4), 0.9)
    before = mesh.points.copy()
    for points in points_after(mesh, METHODS[name](), 5):
        np.testing.assert_array_equal(points[mesh.fixed], before[mesh.fixed])
    np.testing.assert_array_equal(mesh.points, before)


def test_the_first_step_is_where_it_begins_and_the_next_moves(name):
    mesh = scrambled(grid(4), 0.3)
    first, second = points_after(mesh, METHODS[name](), 1)
    np.testing.assert_array_equal(first, mesh.points)
    assert np.abs(second - first).max() > 1e-3


def test_yielded_arrays_are_never_changed_afterwards(name):
    mesh = scrambled(grid(4), 0.3)
    steps = METHODS[name]().steps(mesh)
    kept = [(step.points, step.points.copy()) for step in itertools.islice(steps, 6)]
    for points, copy in kept:
        np.testing.assert_array_equal(points, copy)


def test_any_step_can_be_the_last(name):
    mesh = scrambled(grid(3), 0.3)
    whole = points_after(mesh, METHODS[name](), 4)
    for count in range(1, 5):
        steps = METHODS[name]().steps(mesh)
        last = [next(steps).points for _ in range(count)][-1]
        steps.close()
        np.testing.assert_array_equal(last, whole[count - 1])


def test_a_perfect_grid_is_a_fixed_point(name):
    mesh = grid(4)
    for points in points_after(mesh, METHODS[name](), 3):
        np.testing.assert_allclose(points, mesh.points, atol=1e-12)


@given(seed=st.integers(0, 2**32 - 1), exponent=st.integers(-6, 6))
def test_the_result_moves_turns_and_scales_with_the_mesh(name, seed, exponent):
    random = np.random.default_rng(seed)
    mesh = scrambled(grid(3), 0.2, seed)
    turn, scale, shift = special_ortho_group.rvs(3, random_state=random), 10.0**exponent, random.uniform(-3, 3, 3)
    there = mesh.with_points((mesh.points @ turn.T + shift) * scale)
    here_after = points_after(mesh, METHODS[name](), 3)[-1]
    there_after = points_after(there, METHODS[name](), 3)[-1]
    np.testing.assert_allclose(there_after / scale, here_after @ turn.T + shift, atol=1e-6)


def test_runs_are_bitwise_repeatable_whatever_the_number_of_threads(name):
    mesh = scrambled(grid(6), 0.4)
    np.testing.assert_array_equal(*by_threads(lambda: points_after(mesh, METHODS[name](), 3)[-1]))


def test_numbering_of_hexes_does_not_matter_much(name):
    mesh = scrambled(grid(3), 0.25)
    order = np.random.default_rng(1).permutation(mesh.n_hexes)
    other = type(mesh)(mesh.points, mesh.hexes[order])
    a, b = points_after(mesh, METHODS[name](), 3)[-1], points_after(other, METHODS[name](), 3)[-1]
    np.testing.assert_allclose(a, b, atol=1e-6)  # sums in another order, and a linear solver that ends at 1e-6


def test_quality_rises_on_a_scrambled_gallery_mesh(name):
    mesh = gallery.make("five-side", size=500, scramble=0.25, seed=1)
    before = measure(mesh.points, mesh.hexes).q
    after = measure(points_after(mesh, METHODS[name](), 20)[-1], mesh.hexes).q
    assert after.mean() > before.mean() + 0.01 or after.min() > before.min() + 0.05  # some raise the worst alone


def test_nothing_free_means_nothing_moves(name):
    mesh = grid(1)
    for points in points_after(mesh, METHODS[name](), 2):
        np.testing.assert_array_equal(points, mesh.points)


def test_every_parameter_is_declared_with_help_and_its_default_is_admitted(name):
    cls = METHODS[name]
    assert cls.name == name
    assert cls.title
    assert cls.help.endswith(".")
    assert cls.source
    for one in declared(cls):
        assert one.help
        assert one.check(one.default) == one.default
        assert from_strings(cls, {one.name: str(one.default)}) == cls()
