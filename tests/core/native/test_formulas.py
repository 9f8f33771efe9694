"""Formulas of the kernels, each against the same in NumPy or SciPy."""

import heapq

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend.energy.norm import ObjectiveNorm
from hexmend.energy.quads.surface_quads import SurfaceTerm
from hexmend.energy.terms import ElementBlocks
from hexmend.kernels import LANES
from hexmend.kernels.element_step import element_steps
from hexmend.mesh import hexahedron
from tests.core.grids import grid, scrambled
from tests.core.native.extension import extension

kernels = extension()

# The energy of the boundary quads at a node, against that of all quads.

QUADS = np.array([[0, 1, 2, 3], [4, 0, 3, 5], [6, 7, 0, 4], [1, 0, 7, 8]], dtype=np.int32)
#: 4 * quad + corner that is node 0.
CORNERS = np.array([0, 5, 10, 13], dtype=np.int32)


def random_term(seed, delta, lengths):
    """Make a term of four quads around node 0, of which some corners do not count, and points."""
    random = np.random.default_rng(seed)
    around = np.array([[0, 0], [1, 0], [1, 1], [0, 1], [-1, 0], [-1, 1], [-1, -1], [0, -1], [1, -1]], dtype=float)
    points = np.column_stack([around, np.zeros(9)]) + random.uniform(-0.3, 0.3, (9, 3))
    normals = random.normal(size=(4, 3)) * 0.2 + [0, 0, 1]
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    counted = random.random((4, 4)) < 0.8
    scales = random.uniform(0.5, 2, (2, 4, 4)) if lengths else np.ones((2, 4, 4))
    return points, SurfaceTerm(QUADS, counted, normals, scales, 1.7, delta, ElementBlocks(QUADS), lengths)


def at_node(points, term, norm, y, factor=1.0):
    count = len(QUADS)
    inverse = np.ascontiguousarray(term.scales.transpose(1, 2, 0)).reshape(count, 8) if term.has_lengths else None
    inverse = None if inverse is None else inverse * factor  # lengths shrink as the points do
    rows = term.counted.view(np.uint8), term.normals, inverse
    return kernels.node_quads.quads_at_node(
        np.ascontiguousarray(points / factor), QUADS, CORNERS, *rows, (term.weight, term.delta, factor), tuple(norm), y
    )


@given(st.integers(0, 2**32 - 1), st.sampled_from([0.05, 0.4]), st.sampled_from([1.0, 2.0, 3.5]), st.booleans())
def test_value_and_derivatives_are_those_of_all_quads(seed, delta, p, lengths):
    points, term = random_term(seed, delta, lengths)
    norm, y = ObjectiveNorm(p, 1.0), np.random.default_rng(seed).uniform(-0.2, 0.2, 3)
    value, gradient, hessian, moved = at_node(points, term, norm, y.tolist(), factor=3.0)
    there = points.copy()
    there[0] += y
    assert value == pytest.approx(term.value(points, norm), rel=1e-10)
    assert moved == pytest.approx(term.value(there, norm), rel=1e-10)
    np.testing.assert_allclose(gradient, term.gradient(points, norm)[0], rtol=1e-9, atol=1e-9 * value)
    t = 1e-6
    rises = []
    for axis in np.eye(3):
        ahead, back = points.copy(), points.copy()
        ahead[0] += t * axis
        back[0] -= t * axis
        rises.append((term.gradient(ahead, norm)[0] - term.gradient(back, norm)[0]) / (2 * t))
    xx, xy, xz, yy, yz, zz = hessian
    matrix = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    np.testing.assert_allclose(matrix, rises, rtol=1e-5, atol=1e-6 * np.abs(matrix).max())


def test_a_flipped_quad_is_infinite_without_delta():
    points, term = random_term(1, 0.0, False)
    points[0] = [2.0, 2.0, 0.0]
    assert at_node(points, term, (2.0, 1.0), [0.0, 0.0, 0.0])[0] == np.inf == term.value(points, ObjectiveNorm())


# Symmetric 3 x 3 matrices in the kernels: eigenvalues, solutions and Newton's direction.


symmetric = extension().symmetric
seeds = st.integers(0, 2**32 - 1)


def matrix_of(xx, xy, xz, yy, yz, zz):
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


@given(seeds, st.integers(-8, 8))
def test_symmetric_matrices_of_three_rows(seed, exponent):
    random = np.random.default_rng(seed)
    entries = random.normal(size=6) * 10.0**exponent
    right = random.normal(size=3)
    values = np.linalg.eigvalsh(matrix_of(*entries))
    least, greatest = symmetric.extreme_eigenvalues(entries)
    assert (least, greatest) == pytest.approx((values[0], values[2]), rel=1e-6, abs=1e-9 * np.abs(values).max())
    solution = np.array(symmetric.solve(entries, right))
    scale = np.abs(solution).max() * np.abs(entries).max()
    np.testing.assert_allclose(matrix_of(*entries) @ solution, right, atol=1e-10 * max(scale, 1))


def test_special_symmetric_matrices():
    assert symmetric.extreme_eigenvalues([2.0, 0.0, 0.0, 2.0, 0.0, 2.0]) == (2.0, 2.0)
    assert symmetric.extreme_eigenvalues([1.0, 0.0, 0.0, 3.0, 0.0, 3.0]) == pytest.approx((1, 3))
    assert symmetric.solve([0.0] * 6, [1.0, 2.0, 3.0]) == [0.0, 0.0, 0.0]


@given(seeds)
def test_modified_newton_of_a_node_is_algorithm_a_4(seed):
    random = np.random.default_rng(seed)
    entries, gradient = random.normal(size=6), random.normal(size=3)
    hessian = matrix_of(*entries)
    values = np.linalg.eigvalsh(hessian)
    if values[0] < 0.001 * values[2]:
        hessian = hessian + (0.001 * values[2] - values[0]) * np.eye(3)
    p = np.array(symmetric.newton(entries, gradient, True))
    np.testing.assert_allclose(hessian @ p, -gradient, atol=1e-7 * max(1, np.abs(p).max()))
    if values[2] > 0.1:  # positive definite now
        assert p @ gradient < 0


# The kernels number the reference hexahedron as `hexmend.mesh.hexahedron` does.


native = extension().hexahedron


@pytest.mark.parametrize("table", ["CORNER_TETRAHEDRA", "EDGES", "DIAGONALS", "FACES", "UNIT_CUBE"])
def test_a_table_is_the_same_in_both_languages(table):
    np.testing.assert_array_equal(getattr(native, table), getattr(hexahedron, table))


def test_the_faces_at_a_corner_turn_their_triangle_outwards():
    centres = hexahedron.UNIT_CUBE[hexahedron.FACES].mean(axis=1)
    for corner, faces in zip(hexahedron.UNIT_CUBE, native.CORNER_FACES, strict=True):
        a, b, c = centres[list(faces)]
        towards = 2 * corner - 1
        np.testing.assert_array_equal(np.cross(b - a, c - a), 0.25 * towards)


def test_a_rotated_hex_is_the_same_hex():
    for corner, rotated in enumerate(native.ROTATIONS):
        assert rotated[0] == corner
        x, there = hexahedron.UNIT_CUBE[list(rotated)], hexahedron.UNIT_CUBE
        distances = [np.linalg.norm(places[:, None] - places, axis=-1) for places in (x, there)]
        np.testing.assert_array_equal(*distances)
        assert np.linalg.det(x[[1, 3, 4]] - x[0]) == 1  # rotated, not mirrored


# h(sigma) and h^(-2/3) over the whole range of floats.


def power_minus_two_thirds(h):
    powers = np.empty(1)
    kernels.barrier.power_minus_two_thirds(np.array([h]), powers)
    return powers[0]


def barrier(sigma, delta):
    h, r = np.empty(1), np.empty(1)
    kernels.barrier.barrier(np.array([sigma]), delta, h, r)
    return h[0], r[0]


@given(st.floats(min_value=1e-300, max_value=1e300))
def test_the_fast_power_is_the_power(h):
    assert power_minus_two_thirds(h) == pytest.approx(h ** (-2 / 3), rel=1e-13)


@given(st.floats(-1e6, 1e6), st.floats(1e-6, 1e3))
def test_barrier_is_positive_and_solves_its_equation(sigma, delta):
    h, r = barrier(sigma, delta)
    assert h > 0
    assert r == pytest.approx(np.hypot(sigma, 2 * delta))
    assert h * (h - sigma) == pytest.approx(delta * delta, rel=1e-6, abs=1e-12 * max(1, sigma * sigma))


@given(st.floats(-1e6, 1e6))
def test_without_delta_the_barrier_is_sigma_or_zero(sigma):
    assert barrier(sigma, 0.0)[0] == max(sigma, 0.0)


# The priority queue of sequential GETMe against a heap.


@given(st.lists(st.integers(0, 9), min_size=1, max_size=40), st.lists(st.tuples(st.integers(0, 39), st.integers(0, 9))))
def test_the_queue_gives_what_a_heap_gives(keys, changes):
    key = np.array(keys, dtype=float)
    members = np.arange(len(keys), dtype=np.int32)[::-1].copy()  # leaves need not be in the order of the hexes
    tree = kernels.tournament.tournament(key, members)
    leaf = np.argsort(members)
    for h, new in [(0, keys[0]), *((h % len(keys), new) for h, new in changes)]:
        key[h] = new
        kernels.tournament.replay(tree, key, leaf[h])
        heap = [(k, i) for i, k in enumerate(key)]
        heapq.heapify(heap)
        assert tree[1] == heap[0][1]


# GETMe's element step of a block of hexes against that of one hex.


@pytest.mark.parametrize("count", [1, LANES - 1, LANES + 1, 300])
def test_a_block_of_hexes_takes_the_steps_of_each(count):
    mesh = scrambled(grid(7), 0.6, count)
    hexes = mesh.hexes[:count]
    places = np.full((count, 8, 3), np.nan)
    element_steps(mesh.points, hexes, 1.5, 0.6, places)
    for h in range(count):
        np.testing.assert_allclose(
            places[h], kernels.element_step.element_step(mesh.points[hexes[h]], 1.5, 0.6), atol=1e-12
        )
