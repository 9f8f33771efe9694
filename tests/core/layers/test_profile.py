"""Heights fitted to one first height: stacks keep their thickness, and perfect ones every bit but rounding."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from hexmend.layers import find_layers
from hexmend.layers.targets import first_height, fitted_lengths
from hexmend.target import given_lengths
from tests.core.layers.stacks import stack


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
