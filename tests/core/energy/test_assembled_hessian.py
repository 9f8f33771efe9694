"""Assembled Hessian against the matrix-free product, and its linear solver.

Packed blocks of an assembled Hessian against those in single precision, and the systems that they solve.

Energies of one mesh used by several threads at once.
"""

from concurrent.futures import ThreadPoolExecutor
from threading import Barrier

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hexmend.boundary import SlidingBoundary
from hexmend.energy import MeshEnergy, ObjectiveNorm
from hexmend.energy.assembled_hessian import AssembledHessian, unpack_symmetric
from hexmend.energy.hex_energy import pack_corners
from hexmend.energy.sparsity import BlockSparsity
from hexmend.errors import MeshError
from hexmend.gallery import make
from hexmend.kernels import assembly, conjugate_gradients
from tests.core.energy.projected import projected_energy
from tests.core.grids import grid, scrambled

seeds = st.integers(0, 2**32 - 1)
deltas = st.sampled_from([(0.15, 0.0), (0.15, 0.1), (0.9, 0.02), (3.0, 0.5)])
exponents = st.sampled_from([1.0, 2.0, 3.5])


def hessian_of(mesh, delta=0.0, p=2.0, omitted=None, shift=0.0):
    energy = MeshEnergy(mesh, ObjectiveNorm(p), omitted)
    return energy.hessian(energy.to_edge_units(mesh.points), delta).shifted(shift)


def some_left_out(mesh, share, seed):
    bits = np.random.default_rng(seed).uniform(size=(mesh.n_hexes, 8)) < share
    return pack_corners(bits)


def by_parts(hessian, parts):
    """Assemble the matrix with another division of its slots."""
    hessian.energy.reduction.ordered_nodes = BlockSparsity(hessian.energy.mesh, parts)
    return hessian.assembled(np.float64)


@given(seeds, deltas, exponents, st.sampled_from([0.0, 0.3]))
def test_the_matrix_is_the_product(seed, case, p, share):
    mesh = scrambled(grid(6, 4, 3), case[0], seed)
    hessian = hessian_of(mesh, case[1], p, some_left_out(mesh, share, seed), 0.25)
    assembled = hessian.assembled(np.float64)
    matrix, dense = assembled.matrix().toarray(), hessian @ np.eye(hessian.shape[0])
    size = np.abs(dense).max()
    np.testing.assert_allclose(matrix, dense, atol=1e-12 * size)
    np.testing.assert_array_equal(matrix, matrix.T)
    np.testing.assert_allclose(assembled @ np.eye(len(matrix)), dense, atol=1e-12 * size)
    blocks = np.array([matrix[3 * k : 3 * k + 3, 3 * k : 3 * k + 3] for k in range(len(matrix) // 3)])
    np.testing.assert_array_equal(unpack_symmetric(assembled.diagonal_blocks), blocks)
    single = hessian.assembled().matrix().toarray()
    np.testing.assert_allclose(single, dense, atol=1e-6 * size)


@pytest.mark.parametrize("shares", [1, 2, 3, 7])
def test_the_matrix_is_the_same_to_the_last_bit_however_many_threads_share_it(monkeypatch, shares):
    mesh = scrambled(grid(9), 0.4)
    hessian = hessian_of(mesh, 0.05)
    one = hessian.assembled()
    monkeypatch.setattr("hexmend.energy.hessian.threads", lambda: shares)
    other = hessian.assembled()
    np.testing.assert_array_equal(one.off_diagonal, other.off_diagonal)
    np.testing.assert_array_equal(one.diagonal, other.diagonal)


def test_what_single_precision_cannot_hold_is_cut():
    mesh = grid(4)
    points = mesh.points.copy()
    points[mesh.hexes[21, 4:], 2] = points[mesh.hexes[21, :4], 2] + 1e-13  # all but flat
    assembled = hessian_of(mesh.with_points(points)).assembled()
    assert np.abs(assembled.off_diagonal).max() > 1e30
    assert np.isfinite(assembled.off_diagonal).all()
    assert np.isfinite(assembled.diagonal).all()


def test_opposite_corners_have_a_block_only_where_the_energy_couples_them():
    """Inside a grid a node has 26 neighbours, 8 of which only opposite corners of hexes join."""
    energies = MeshEnergy(grid(7), ObjectiveNorm(1)), MeshEnergy(grid(7))
    counts = []
    for energy in energies:
        sparsity, points = energy.sparsity, energy.to_edge_units(energy.mesh.points)
        rows = np.repeat(sparsity.nodes, np.diff(sparsity.row_start))
        apart = np.abs(points[rows] - points[sparsity.nodes[sparsity.columns]]).sum(axis=1).round()
        counts.append(np.bincount(apart.astype(int), minlength=4).tolist())
    (_, *few, none), (_, *same, opposite) = counts
    assert (few, none) == (same, 0)
    assert opposite == 4 * 5**3  # a block above the diagonal for each diagonal of the hexes inside


@settings(max_examples=2)
@given(seed=seeds)
def test_parts_change_the_way_but_not_the_solution(seed):
    hessian = hessian_of(scrambled(grid(14, 3, 3), 0.15, seed), shift=0.5)
    matrix = hessian.assembled(np.float64).matrix().toarray()
    right = np.random.default_rng(seed).normal(size=len(matrix))
    assembled = by_parts(hessian, 3)
    solved = assembled.solve(right, 1e-10, 500)
    solution, count = solved.x, solved.iterations
    np.testing.assert_allclose(solution, np.linalg.solve(matrix, right), atol=1e-7 * np.abs(solution).max())
    assert count < 100
    np.testing.assert_allclose(assembled @ right, matrix @ right, atol=1e-11 * np.abs(matrix).max())


@given(seeds, st.floats(-5, 1), st.sampled_from([np.float32, np.float64]))
def test_the_solution_descends_whatever_the_curvature(seed, shift, precision):
    hessian = hessian_of(scrambled(grid(4), 0.15, 3), shift=shift)
    right = np.random.default_rng(seed).normal(size=hessian.shape[0])
    assert hessian.assembled(precision).solve(right, 1e-3, 50).x @ right > 0


def test_damping_adds_a_multiple_of_the_diagonal_and_makes_the_matrix_positive_definite():
    hessian = hessian_of(scrambled(grid(5), 0.15, 3), shift=0.5)
    assembled, right = hessian.assembled(np.float64), np.random.default_rng(1).normal(size=hessian.shape[0])
    matrix = assembled.matrix().toarray()
    block = np.arange(len(matrix)) // 3
    damped = matrix + 0.3 * np.where(block[:, None] == block, matrix, 0)
    solved = assembled.solve(right, 1e-12, 200, 0.3)
    np.testing.assert_allclose(solved.x, np.linalg.solve(damped, right), atol=1e-8)
    indefinite = hessian.shifted(-1.0).assembled()
    assert indefinite.solve(right, 1e-3, 100).negative_curvature
    assert not indefinite.solve(right, 1e-3, 100, 20.0).negative_curvature


@pytest.mark.parametrize("precision", [np.float32, np.float64])
@pytest.mark.parametrize("size", [1e-300, 1e-40, 1e-15, 1e20, 2.0**1023])
def test_the_solution_is_as_large_as_the_right_hand_side(size, precision):
    hessian = hessian_of(scrambled(grid(5), 0.15, 3), shift=0.5)
    right = np.random.default_rng(2).normal(size=hessian.shape[0])
    right /= np.abs(right).max()
    assembled = hessian.assembled(precision)
    usual, other = assembled.solve(right, 1e-3, 100), assembled.solve(size * right, 1e-3, 100)
    assert usual.iterations > 0
    assert (other.iterations, other.negative_curvature) == (usual.iterations, False)
    np.testing.assert_allclose(other.x / size, usual.x, atol=1e-5 * np.abs(usual.x).max())


def test_a_solution_beyond_the_range_of_numbers_is_infinite_and_one_below_it_is_0():
    assembled = hessian_of(scrambled(grid(4), 0.15, 3)).assembled(np.float64)
    tiny = AssembledHessian(assembled.sparsity, assembled.off_diagonal, assembled.diagonal, -100)
    assert np.isinf(tiny.solve(np.full(tiny.shape[0], 2.0**1000), 1e-3, 100).x).any()
    huge = AssembledHessian(assembled.sparsity, assembled.off_diagonal, assembled.diagonal, 1000)
    assert not huge.solve(np.full(huge.shape[0], 2.0**-900), 1e-3, 100).x.any()


@pytest.mark.parametrize(
    "of", [MeshEnergy, lambda mesh: projected_energy(SlidingBoundary(mesh))], ids=["free", "sliding"]
)
@pytest.mark.parametrize("shape", [(3,), (8, 3)])
def test_a_vector_of_another_length_is_refused_by_every_matrix(of, shape):
    mesh = grid(3)
    energy = of(mesh)
    hessian = energy.hessian(energy.to_edge_units(mesh.points))
    assembled, vector, words = hessian.assembled(), np.ones(shape), rf"has shape .*: expected \({hessian.shape[0]},\)"
    for take in (hessian.matvec, assembled.matvec, lambda v: assembled.solve(v, 1e-3, 5)):
        with pytest.raises(MeshError, match=words):
            take(vector)
    with pytest.raises(MeshError, match="the right-hand side are of type complex128"):
        assembled.solve(np.ones(hessian.shape[0]) + 0j, 1e-3, 5)


#: Largest error of a number, relative to the largest of its block.
ROUNDING = 2.0**-19


def both(mesh, delta=0.0, p=2.0, parts=None, shares=1):
    """Assemble the Hessian of a mesh in single precision, as it is and packed."""
    energy = MeshEnergy(mesh, ObjectiveNorm(p))
    if parts:
        energy.reduction.ordered_nodes = BlockSparsity(mesh, parts)
    x = energy.to_edge_units(mesh.points)
    whole = energy.hessian(x, delta).assembled()
    packed = AssembledHessian.zero(energy.sparsity, np.float32, packed=True)
    packed.off_diagonal.fill(7)  # every block is written
    assemble(packed, energy, x, delta, shares)
    return whole, packed


def assemble(packed, energy, x, delta=0.0, shares=2):
    """Assemble a packed matrix; returns the number of stretched nodes."""
    sparsity, blocks = energy.sparsity, (packed.off_diagonal, packed.diagonal)
    given = x, delta, energy.norm, energy.omitted, sparsity.shares(shares), sparsity.first_separator
    assembly.assemble_packed(*given, *blocks)
    return conjugate_gradients.complete_diagonal(sparsity.pattern, *blocks)


@given(
    st.integers(0, 2**32 - 1),
    st.sampled_from([(0.15, 0.0), (0.15, 0.1), (0.9, 0.02), (3.0, 0.5)]),
    st.sampled_from([1.0, 2.0, 3.5]),
    st.sampled_from([1, 2, 4]),
    st.sampled_from([1, 2, 3, 7]),
)
def test_packed_blocks_are_rounded(seed, case, p, parts, shares):
    whole, packed = both(scrambled(grid(7, 4, 3), case[0], seed), case[1], p, parts, shares)
    exact, rounded = whole.off_diagonal[:-1], packed.unpacked_blocks()[:-1]
    largest = np.abs(exact).max(axis=1, keepdims=True)
    assert (np.abs(exact - rounded) <= ROUNDING * largest).all()
    np.testing.assert_allclose(packed.diagonal, whole.diagonal, atol=26 * ROUNDING * largest.max())
    np.testing.assert_allclose(packed.matrix().toarray(), whole.matrix().toarray(), atol=26 * ROUNDING * largest.max())


def test_the_product_and_the_solution_are_those_of_the_unpacked_matrix():
    whole, packed = both(scrambled(grid(9), 0.3, 5), 0.1, parts=2)
    unpacked = AssembledHessian(packed.sparsity, packed.unpacked_blocks(), packed.diagonal)
    v = np.random.default_rng(3).normal(size=whole.shape[0])
    np.testing.assert_allclose(packed @ v, unpacked @ v, rtol=1e-12, atol=1e-12 * np.abs(unpacked @ v).max())
    solved, same, rounded = (matrix.solve(v, 1e-5, 500) for matrix in (packed, unpacked, whole))
    assert abs(solved.iterations - same.iterations) <= 1
    np.testing.assert_allclose(solved.x, same.x, atol=1e-4 * np.abs(same.x).max())
    np.testing.assert_allclose(solved.x, rounded.x, atol=1e-3 * np.abs(rounded.x).max())


def test_the_sums_of_a_packed_matrix_are_the_same_to_the_last_bit_however_many_threads_share_it():
    mesh = scrambled(grid(14, 3, 3), 0.3, 7)
    (_, one), *others = (both(mesh, 0.05, 1.0, 3, shares) for shares in (1, 2, 5))
    for _, packed in others:
        np.testing.assert_array_equal(packed.off_diagonal, one.off_diagonal)
        np.testing.assert_array_equal(packed.diagonal, one.diagonal)


@pytest.mark.parametrize("flat", [1, pytest.param(30, marks=pytest.mark.slow)])
def test_long_waves_have_the_curvature_of_the_exact_matrix(flat):
    """Of flat hexes: the least eigenvalue, scaled by the diagonal, is far below the rounding of a stiff block."""
    mesh = scrambled(grid(7), 0.1, 1)
    mesh = mesh.with_points(mesh.points * np.array([1, 1, 1 / flat]))
    _, packed = both(mesh, p=1.0)
    energy = MeshEnergy(mesh, ObjectiveNorm(1.0))
    exact = energy.hessian(energy.to_edge_units(mesh.points)).assembled(np.float64).matrix().toarray()
    scale = 1 / np.sqrt(np.diag(exact))
    least = [np.linalg.eigvalsh(scale[:, None] * matrix * scale)[0] for matrix in (packed.matrix().toarray(), exact)]
    assert least[0] == pytest.approx(least[1], rel=2e-3)


def test_meshes_that_are_too_flat_for_packed_blocks_do_not_get_them(monkeypatch):
    monkeypatch.setattr("hexmend.energy.sparsity._LARGE", 1)
    for flat, packed in ((100, True), (1000, False)):
        mesh = scrambled(grid(5), 0.1, 1)
        energy = MeshEnergy(mesh.with_points(mesh.points * np.array([1, 1, 1 / flat])), ObjectiveNorm(1.0))
        x = energy.to_edge_units(energy.mesh.points)
        assert energy.hessian(x).assembled().packed == packed
        assert energy.sparsity.packs == packed


def test_the_gradient_has_the_memory_of_a_packed_matrix_until_the_next_one_is_assembled(monkeypatch):
    monkeypatch.setattr("hexmend.energy.sparsity._LARGE", 1)
    energy = MeshEnergy(scrambled(grid(6), 0.1, 1), ObjectiveNorm(1.0))
    x = energy.to_edge_units(energy.mesh.points)
    there = energy.moved(x, np.full((energy.nodes.size, 3), 1e-3) * np.arange(3))
    expected, gradient = energy.hessian(there).assembled().unpacked_blocks(), energy.gradient(there)
    matrix = energy.hessian(x).assembled()
    blocks = matrix.off_diagonal
    workspace = energy.sparsity.workspace
    assert not np.shares_memory(blocks, energy.corner_buffer)
    matrix.lend_memory()
    matrix.lend_memory()  # once is enough
    assert np.shares_memory(blocks, workspace.array((blocks.nbytes,), np.uint8))
    np.testing.assert_array_equal(energy.gradient(there), gradient)
    again = energy.hessian(there).assembled(reuse=matrix)
    assert again is matrix
    np.testing.assert_array_equal(energy.gradient(there), gradient)  # in other memory than the matrix
    np.testing.assert_array_equal(again.unpacked_blocks(), expected)


POWERS = ObjectiveNorm(2.0, 1.0), ObjectiveNorm(4.0, 0.0)


def energies_of(kind):
    """Make two energies of one mesh that share the data that depend on the mesh alone."""
    mesh = make("bridge-sharp", size=2000)
    first = MeshEnergy(mesh, POWERS[0]) if kind == "fixed" else projected_energy(SlidingBoundary(mesh), POWERS[0])
    return first, first.with_objective(POWERS[1], first.omitted)


def answers(energy, x, steps=10):
    """Compute gradients and Hessian products at different points."""
    found = []
    for k in range(steps):
        there = x * (1 + 1e-3 * k)
        gradient = energy.gradient(there, 0.1)
        found += [gradient, energy.hessian(there, 0.1).matvec(gradient.ravel())]
    return found


@pytest.mark.parametrize("kind", ["fixed", "slide"])
@pytest.mark.parametrize("copies", [True, False])
def test_two_threads_get_what_each_gets_alone(kind, copies):
    first, second = energies_of(kind)
    both = (first, second if copies else first)
    x = first.to_edge_units(first.mesh.points)
    places = (x, 1.7 * x)
    alone = [answers(energy, place) for energy, place in zip(both, places, strict=True)]
    together = Barrier(2)

    def run(energy, place):
        together.wait()
        return answers(energy, place)

    with ThreadPoolExecutor(2) as pool:
        found = list(pool.map(run, both, places))
    for mine, expected in zip(found, alone, strict=True):
        for one, other in zip(mine, expected, strict=True):
            np.testing.assert_array_equal(one, other)
