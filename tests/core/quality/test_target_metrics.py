"""Metrics against the target of a mesh: perfect where hexes are as the target wants them, and neutral without one."""

import numpy as np
import pytest

from hexmend import METRICS, Target, measure
from hexmend.target import given_lengths, make_target
from tests.core.layers.stacks import scrambled_in_layers, stack


def values(mesh, name):
    return METRICS[name].values(mesh, measure(mesh.points, mesh.hexes))


@pytest.mark.parametrize("name", ["q-of-target", "size-against-target", "aspect-against-given"])
def test_blocks_as_the_target_wants_them_are_perfect(name):
    mesh = stack()
    np.testing.assert_allclose(values(mesh.with_element_target(make_target(mesh, "given")), name), 1)


def test_without_a_target_q_is_that_of_cubes_and_the_others_are_one():
    mesh = scrambled_in_layers(stack(), 0.3)
    np.testing.assert_array_equal(values(mesh, "q-of-target"), values(mesh, "q"))
    assert (values(mesh, "size-against-target") == 1).all()
    assert (values(mesh, "aspect-against-given") == 1).all()


def test_sizes_and_proportions_are_relative_to_the_target():
    mesh = stack()
    lengths = given_lengths(mesh)
    larger = mesh.with_element_target(Target(lengths / 2))
    np.testing.assert_allclose(values(larger, "size-against-target"), 2)
    np.testing.assert_allclose(values(larger, "aspect-against-given"), 1)
    np.testing.assert_allclose(values(larger, "q-of-target"), 1)
    flatter = mesh.with_element_target(Target(lengths * [1, 1, 8]))
    np.testing.assert_allclose(values(flatter, "size-against-target"), 0.5)
    np.testing.assert_allclose(values(flatter, "aspect-against-given"), 8)
    assert (values(flatter, "q-of-target") < 0.5).all()


def test_a_hex_without_extent_has_the_worse_end():
    mesh = stack(2, 2, 5)
    flat = mesh.with_element_target(make_target(mesh, "given")).with_points(mesh.points * [1, 1, 0])
    assert np.isposinf(values(flat, "aspect-against-given")).all()
    assert (values(flat, "size-against-target") == 0).all()
