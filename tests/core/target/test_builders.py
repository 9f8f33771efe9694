"""Targets by name: ratios, sizes, data and formulas, and one clear sentence for what is wrong."""

import numpy as np
import pytest

from hexmend.errors import ParameterError
from hexmend.target import SPECIFICATIONS, given_lengths, make_target
from tests.core.layers.stacks import stack


def test_ideal_is_no_target():
    assert make_target(stack(), "ideal") is None


@pytest.mark.parametrize("name", sorted(set(SPECIFICATIONS) - {"ideal"}))
def test_targets_as_given_have_the_size_of_the_hexes(name):
    mesh = stack()
    target = make_target(mesh, name, 0.5)
    np.testing.assert_allclose(target.lengths.prod(axis=1), given_lengths(mesh).prod(axis=1))
    assert target.name == name
    assert target.size_weight == (0 if name == "given-shape" else 0.5)
    if name == "given-size":
        np.testing.assert_allclose(target.lengths, target.lengths[:, :1] * [1, 1, 1])
    else:
        np.testing.assert_array_equal(target.lengths, given_lengths(mesh))


def test_formulas_are_computed_at_the_centres():
    mesh = stack()
    centres = mesh.points[mesh.hexes].mean(axis=1)
    np.testing.assert_allclose(make_target(mesh, "0.1 + x").lengths, 0.1 + centres[:, [0, 0, 0]])
    np.testing.assert_allclose(
        make_target(mesh, "1, y, 2").lengths, np.insert(np.full((800, 2), [1.0, 2.0]), 1, centres[:, 1], 1)
    )


def test_data_of_hexes_and_nodes_are_lengths():
    mesh = stack()
    sizes = np.linspace(1, 2, mesh.n_hexes)
    mesh = mesh.replace(
        hex_data={"size": sizes, "my lengths": np.stack([sizes, 2 * sizes, 3 * sizes], axis=1)},
        node_data={"at nodes": 1 + mesh.points[:, 0]},
    )
    np.testing.assert_array_equal(make_target(mesh, "size").lengths, sizes[:, None] * [1, 1, 1])
    np.testing.assert_array_equal(make_target(mesh, "my lengths").lengths, sizes[:, None] * [1, 2, 3])
    np.testing.assert_allclose(make_target(mesh, "2 * size").lengths, 2 * sizes[:, None] * [1, 1, 1])
    centres = mesh.points[mesh.hexes].mean(axis=1)
    np.testing.assert_allclose(make_target(mesh, "at nodes").lengths[:, 0], 1 + centres[:, 0])


@pytest.mark.parametrize(("specification", "complaint"), [
    ("given-shap", "there is no target 'given-shap': expected ideal, given-shape, given-size, given, data"),
    ("x - 100", r"target 'x - 100' is -99.9 at hex 0 .*: expected positive finite lengths .* from 2e-16 to 2e\+14 "),
    ("0", "target '0' is 0 at hex 0"),
    ("1e300", r"target '1e300' is 1e\+300 at hex 0"),
    ("0.1, 1e-300, 0.1", "is 1e-300 at hex 0"),
    ("gap", "target 'gap' is nan at hex 3"),
    ("gap * 2", "is nan at hex 3"),
    ("1, 2", "has 2 values a hex: expected one length, or three"),
    ("log(0) * x", "is -inf at hex 0"),
    ("pair", "has 2 values a hex"),
    ("word", "data 'word' are not lengths"),
])  # fmt: skip
def test_what_is_wrong_is_named(specification, complaint):
    mesh = stack()
    data = {"pair": np.ones((mesh.n_hexes, 2)), "word": np.full(mesh.n_hexes, "a"), "gap": np.ones(mesh.n_hexes)}
    data["gap"][3] = np.nan
    with pytest.raises(ParameterError, match=complaint):
        make_target(mesh.replace(hex_data=data), specification)


def test_the_range_of_lengths_is_relative_to_the_mesh():
    mesh = stack()
    large = mesh.with_points(mesh.points * 1e20)
    assert make_target(large, "1e20").lengths[0, 0] == 1e20
    with pytest.raises(ParameterError, match="is 1 at hex 0"):
        make_target(large, "1")
