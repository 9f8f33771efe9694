"""Packed blocks of an assembled Hessian against those in single precision, and the systems that they solve."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend.energy import MeshEnergy, ObjectiveNorm
from hexmend.energy.assembled_hessian import AssembledHessian
from hexmend.energy.sparsity import BlockSparsity
from hexmend.kernels import assembly, conjugate_gradients
from tests.core.grids import grid, scrambled

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
