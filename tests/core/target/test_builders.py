"""Targets by name: ratios, sizes, data and formulas, and one clear sentence for what is wrong."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend import Mesh, ParameterError, gallery, measure
from hexmend.mesh.hexahedron import EDGES, UNIT_CUBE
from hexmend.target import SPECIFICATIONS, given_lengths, make_target, recovered_lengths
from hexmend.target.builders import FUNCTIONS, evaluate
from hexmend.target.sheets import edge_numbers
from tests.core.layers.stacks import renumbered, scrambled_in_layers, stack


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


# Lengths recovered along dual sheets: as given where a mesh is sound, as meant where it is tangled.


def test_lengths_of_a_sound_mesh_are_as_given_to_the_last_bit():
    for mesh in (stack(), gallery.make("five-side", size=500), gallery.make("layered", size=2000)):
        np.testing.assert_array_equal(recovered_lengths(mesh), given_lengths(mesh))


@given(growth=st.floats(1.05, 1.6), first=st.floats(1e-4, 1e-2), seed=st.integers(0, 100))
def test_lengths_of_a_tangled_stack_are_those_before(growth, first, seed):
    mesh = stack(layers=6, first=first, growth=growth)
    tangled = scrambled_in_layers(mesh, 0.7, seed)
    assert measure(tangled.points, tangled.hexes).n_inverted > 100
    np.testing.assert_allclose(recovered_lengths(tangled), given_lengths(mesh), rtol=0.05)


@given(seed=st.integers(0, 100))
def test_recovered_lengths_follow_the_numbering_of_a_hex(seed):
    tangled = scrambled_in_layers(stack(6, 6, 5), 0.7, seed)
    turned, directions = renumbered(tangled, seed)
    expected = np.take_along_axis(recovered_lengths(tangled), directions, axis=1)
    np.testing.assert_allclose(recovered_lengths(turned), expected, rtol=1e-9)


def test_growth_is_preserved_across_layers():
    mesh = scrambled_in_layers(stack(8, 8, 10, first=1e-3, growth=1.4), 0.6)
    heights = recovered_lengths(mesh)[:, 2].reshape(10, -1)
    np.testing.assert_allclose(heights[1:] / heights[:-1], 1.4, rtol=0.05)


SLOW = [pytest.param(name, marks=pytest.mark.slow) for name in ("pierrot_32735.mesh", "naca_viscous.cgns")]


@pytest.mark.parametrize("name", ["cub_fru.vtk", *SLOW])
def test_meshes_that_are_sound_keep_their_lengths(name, sample_mesh):
    mesh = sample_mesh(name)
    np.testing.assert_array_equal(recovered_lengths(mesh), given_lengths(mesh))


def test_a_badly_tangled_mesh_has_positive_lengths():
    lengths = recovered_lengths(gallery.make("cube", size=216, scramble=5.0))
    assert (lengths > 0).all()
    assert np.isfinite(lengths).all()


# Lengths of hexes: means of parallel edges, in the order of the hex's own numbering.


@given(seed=st.integers(0, 100))
def test_lengths_follow_the_numbering_of_a_hex(seed):
    mesh = stack(4, 3, 5)
    turned, directions = renumbered(mesh, seed)
    expected = np.take_along_axis(given_lengths(mesh), directions, axis=1)
    np.testing.assert_allclose(given_lengths(turned), expected, rtol=1e-12)


def test_lengths_are_positive_where_a_hex_has_none():
    flat = Mesh(UNIT_CUBE * [1, 1, 0], [range(8)])
    assert (given_lengths(flat) > 0).all()
    mirrored = Mesh(UNIT_CUBE * [1, 2, -3], [range(8)])
    np.testing.assert_allclose(given_lengths(mirrored), [[1, 2, 3]])


def test_every_edge_of_a_hex_has_its_number():
    mesh = gallery.make("five-side", size=500)
    numbers = edge_numbers(mesh.topology)
    ends = np.sort(mesh.hexes[:, EDGES], axis=2)
    np.testing.assert_array_equal(mesh.topology.edges[numbers], ends)


# Formulas: arithmetic as Python has it, and nothing else.


NUMBERS = st.floats(0.1, 10)


@given(x=NUMBERS, y=NUMBERS)
def test_arithmetic_is_that_of_python(x, y):
    text = "-x + 2 * y ** 2 / (x + 1) - min(x, y) + where(x > y, sin(pi * x), hypot(x, y))"
    expected = -x + 2 * y**2 / (x + 1) - min(x, y) + (math.sin(math.pi * x) if x > y else math.hypot(x, y))
    assert evaluate(text, {"x": np.array([x]), "y": np.array([y])})[0] == pytest.approx([expected])


def test_several_formulas_have_commas_between_them():
    assert [value.tolist() for value in evaluate("x, 2 * x, 1", {"x": np.array([3.0])})] == [[3.0], [6.0], 1.0]


@pytest.mark.parametrize("text", [
    "__import__('os').system('true')", "x.__class__", "x[0]", "(lambda: 1)()", "[x for x in y]", "open('a')", "f'{x}'",
    "x if y else z", "x and y", "'text'", "True", "1j", "sin", "sin(x, out=x)", "print(x)", "x @ x", "x % 2", "x // 2",
    "x := 3", "import os", "", "x +", "x < y < z", "{1: 2}", "*x, y", "sin(*x)", "...", "~x", "x == y", "x\ny", "\0",
])  # fmt: skip
def test_what_is_no_arithmetic_is_refused(text):
    ones = np.ones(2)
    with pytest.raises(ParameterError, match="formula"):
        evaluate(text, {"x": ones, "y": ones, "z": ones})


@pytest.mark.parametrize(("text", "complaint"), [
    ("9" * 400, "too large"),
    ("x" + "+x" * 300, "601 characters: expected at most 500"),
    ("(" * 240 + "x" + ")" * 240, "cannot be parsed"),
    ("sin(x, y)", "sin has 2 arguments: expected 1"),
    ("where(x)", "where has 1 arguments: expected 3"),
    ("a + 1", "a is not allowed"),
])  # fmt: skip
def test_what_is_wrong_with_a_formula_is_named(text, complaint):
    with pytest.raises(ParameterError, match=complaint):
        evaluate(text, {"x": np.ones(1), "y": np.ones(1)})


def test_huge_powers_are_infinite_and_take_no_time():
    assert np.isinf(evaluate("9**9**9**9", {})[0])


@pytest.mark.parametrize("name", FUNCTIONS)
def test_every_function_takes_arrays(name):
    count = {"atan2": 2, "hypot": 2, "max": 2, "min": 2, "where": 3}.get(name, 1)
    values = evaluate(f"{name}({', '.join(['x'] * count)})", {"x": np.full(3, 0.5)})[0]
    assert values.shape == (3,)
    assert np.isfinite(values).all()
