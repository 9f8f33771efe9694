"""Deflation of conjugate gradients by translations of aggregates of nodes."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hexmend import kernels
from hexmend.energy import MeshEnergy, ObjectiveNorm
from hexmend.energy.sparsity import BlockSparsity
from hexmend.kernels.conjugate_gradients import CoarsePattern
from tests.core.grids import grid, scrambled

seeds = st.integers(0, 2**32 - 1)
parts = pytest.mark.parametrize("parts", [1, 3])


def assembled(mesh, parts=1, distance=2, shift=0.0, precision=np.float64):
    """A Hessian with aggregates of that size, which larger meshes have."""
    energy = MeshEnergy(mesh, ObjectiveNorm(2.0))
    energy.reduction.ordered_nodes = BlockSparsity(mesh, parts)
    energy.sparsity.coarse_space = CoarsePattern(*energy.sparsity.aggregates(distance))
    hessian = energy.hessian(energy.to_edge_units(mesh.points), 0.0)
    return hessian.shifted(shift).assembled(precision)


def translations(sparsity, distance=2):
    """R, (3 k, 3 aggregates), in the order of the free nodes."""
    aggregate = sparsity.aggregates(distance)[0][sparsity.order]
    return np.kron(aggregate[:, None] == np.arange(aggregate.max() + 1), np.eye(3))


def random(matrix, seed=0):
    return np.random.default_rng(seed).normal(size=matrix.shape[0])


@parts
@pytest.mark.parametrize("damping", [0.0, 0.3])
@settings(max_examples=1)
@given(seed=seeds)
def test_the_solution_is_the_same(parts, damping, seed):
    matrix = assembled(scrambled(grid(14, 3, 3), 0.15, seed), parts, shift=0.5)
    right = random(matrix, seed)
    dense = matrix.matrix().toarray()
    block = np.arange(len(dense)) // 3
    dense += damping * np.where(block[:, None] == block, dense, 0)
    solved = matrix.solve(right, 1e-10, 500, damping, deflated=True)
    np.testing.assert_allclose(solved.x, np.linalg.solve(dense, right), atol=1e-7 * np.abs(solved.x).max())


@pytest.mark.parametrize("precision", [np.float32, np.float64])
def test_long_waves_need_fewer_iterations(precision):
    matrix = assembled(scrambled(grid(40, 5, 5), 0.1), 2, distance=3, precision=precision)
    right = np.ones(matrix.shape[0])
    deflated, plain = (matrix.solve(right, 1e-3, 200, deflated=how).iterations for how in (True, False))
    assert deflated < 0.8 * plain


@given(seeds, st.floats(-5, 1), st.sampled_from([np.float32, np.float64]))
def test_the_solution_descends_whatever_the_curvature(seed, shift, precision):
    matrix = assembled(scrambled(grid(6), 0.15, 3), shift=shift, precision=precision)
    right = random(matrix, seed)
    assert matrix.solve(right, 1e-3, 50, deflated=True).x @ right > 0


def test_a_matrix_that_the_coarse_space_shows_to_be_indefinite_is_not_deflated():
    matrix = assembled(scrambled(grid(6), 0.15), shift=-5.0)
    right = random(matrix)
    deflated, plain = (matrix.solve(right, 1e-3, 50, deflated=how) for how in (True, False))
    assert deflated.negative_curvature
    np.testing.assert_array_equal(deflated.x, plain.x)


@parts
def test_the_solution_is_the_same_to_the_last_bit_however_many_threads_there_are(parts):
    matrix, most = assembled(scrambled(grid(14, 3, 3), 0.15), parts, precision=np.float32), kernels.threads()
    right, found = random(matrix), []
    try:
        for count in (1, 2, 5):
            kernels.set_threads(count)
            found.append(matrix.solve(right, 1e-4, 100, deflated=True).x)
    finally:
        kernels.set_threads(most)
    np.testing.assert_array_equal(found[0], found[1])
    np.testing.assert_array_equal(found[0], found[2])
