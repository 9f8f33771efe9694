"""Targets of runs: layers are kept unless another target is asked for."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend.layers import Layers, find_layers, keeps_layers, run_target
from hexmend.layers.targets import first_height, fitted_lengths
from hexmend.mesh.element_target import Target
from hexmend.target import given_lengths
from tests.core.grids import grid
from tests.core.layers.stacks import scrambled_in_layers, stack


@pytest.mark.parametrize(("target", "layers", "kept"), [
    ("auto", "auto", True), ("auto", "keep", True), ("auto", "free", False),
    ("ideal", "auto", False), ("ideal", "keep", True), ("x + 1", "auto", False), ("given-size", "auto", False),
    ("given-shape", "auto", True), ("given", "auto", True), ("given-shape", "free", False),
])  # fmt: skip
def test_layers_are_kept_unless_another_target_is_asked_for(target, layers, kept):
    assert keeps_layers(target, layers) == kept


def test_a_mesh_without_layers_has_no_target_of_its_own():
    assert run_target(grid(3), "auto", Layers()) is None
    assert run_target(grid(3), "ideal", Layers()) is None


def test_the_target_of_a_mesh_with_layers_is_its_shape_as_given():
    mesh = stack()
    target = run_target(mesh, "auto", find_layers(mesh))
    assert (target.name, target.size_weight) == ("given-shape", 0)
    np.testing.assert_array_equal(target.lengths, given_lengths(mesh))


def test_the_target_of_a_tangled_mesh_with_layers_has_one_first_height():
    mesh = scrambled_in_layers(stack(first=1e-3), 0.7)
    layers = find_layers(mesh)
    heights = layers.walls[0].of(run_target(mesh, "auto", layers).lengths)
    np.testing.assert_allclose(heights[:, 0], 1e-3, rtol=0.02)
    np.testing.assert_allclose(heights[:, 1:] / heights[:, :-1], 1.3, rtol=0.02)


def test_a_target_that_the_mesh_has_is_taken_unless_another_is_named():
    own = Target(np.ones((27, 3)), name="own")
    mesh = grid(3).with_element_target(own)
    assert run_target(mesh, "auto", Layers()) is own
    assert run_target(mesh, "ideal", Layers()) is None
    assert run_target(mesh, "given", Layers()).name == "given"


def test_layers_keep_their_lengths_under_another_target():
    base = stack(6, 6, 6, first=0.01, growth=1.3, lateral=0.2)
    layers, own = find_layers(base), given_lengths(base)
    part = Layers((type(layers.walls[0])("plate", layers.walls[0].hexes[:, :3], layers.walls[0].faces[:, :3]),))
    inside = part.hexes
    outside = np.setdiff1d(np.arange(base.n_hexes), inside)
    sized = run_target(base, "0.1", part, 2.0)
    np.testing.assert_array_equal(sized.lengths[inside], own[inside])
    np.testing.assert_array_equal(sized.lengths[outside], 0.1)
    assert (sized.name, sized.size_weight) == ("0.1, layers as given", 2.0)
    cubes = run_target(base, "ideal", part)
    np.testing.assert_array_equal(cubes.lengths[inside], own[inside])
    aspect = np.ptp(np.log(cubes.lengths[outside]), axis=1)
    assert (aspect <= np.ptp(np.log(own[outside]), axis=1) + 1e-12).all()
    np.testing.assert_allclose(cubes.lengths[outside].prod(axis=1), own[outside].prod(axis=1))


# Heights fitted to one first height: stacks keep their thickness, and perfect ones every bit but rounding.


def over_a_bump(mesh, share):
    """Squeeze the stack over a bump of this share of its thickness."""
    x, top = mesh.points[:, 0] / mesh.points[:, 0].max(), mesh.points[:, 2].max()
    bump = share * np.sin(np.pi * x) ** 2
    return mesh.with_points(mesh.points + np.outer(bump * (top - mesh.points[:, 2]), [0, 0, 1]))


@given(growth=st.floats(1.1, 1.5), layers=st.integers(5, 12))
def test_equal_columns_keep_their_heights(growth, layers):
    mesh = stack(layers=layers, first=1e-3, growth=growth)
    lengths = given_lengths(mesh)
    np.testing.assert_allclose(fitted_lengths(lengths, find_layers(mesh)), lengths, rtol=1e-9)


@given(share=st.floats(0.05, 0.4))
def test_squeezed_columns_get_the_first_height_of_the_others_and_keep_their_thickness(share):
    mesh = over_a_bump(stack(24, 6, 14, first=1e-3, growth=1.25, lateral=0.1), share)
    layers, lengths = find_layers(mesh), given_lengths(mesh)
    (wall,) = layers.walls
    before, after = wall.of(lengths), wall.of(fitted_lengths(lengths, layers))
    np.testing.assert_allclose(np.nansum(after, axis=1), np.nansum(before, axis=1), rtol=1e-9)
    np.testing.assert_allclose(after[:, 0], first_height(wall, lengths), rtol=1e-9)
    np.testing.assert_allclose(after[:, 0], 1e-3, rtol=0.02)
    ratios = after[:, 1:] / after[:, :-1]
    np.testing.assert_allclose(ratios, ratios[:, :1] * np.ones(ratios.shape[1]), rtol=1e-6)
    others = given_lengths(mesh)[:, :2]
    np.testing.assert_array_equal(fitted_lengths(lengths, layers)[:, :2], others)


def test_a_wall_without_one_first_height_stays():
    mesh = stack(24, 6, 8, first=1e-3, growth=1.3, lateral=0.1)
    wedge = mesh.points * [1, 1, 0] + mesh.points * [0, 0, 1] * (1 + 4 * mesh.points[:, [0]])
    mesh = mesh.with_points(wedge)
    lengths = given_lengths(mesh)
    np.testing.assert_array_equal(fitted_lengths(lengths, find_layers(mesh)), lengths)
