"""Diagonal blocks in other coordinates, and projectors along a surface, against NumPy."""

import numpy as np
import pytest

from hexmend.energy.assembled_hessian import unpack_symmetric
from hexmend.kernels import conjugate_gradients, sliding_surface

UPPER = [0, 1, 2, 4, 5, 8]
PRECISIONS = [np.float32, np.float64]


def directions(rng, count):
    """Two orthonormal directions in columns, one in every fifth of them."""
    bases = np.linalg.qr(rng.normal(size=(count, 3, 3)))[0]
    bases[:, :, 2] = 0
    bases[::5, :, 1] = 0
    return np.ascontiguousarray(bases)


def close(found, expected):
    np.testing.assert_allclose(found, expected, rtol=0, atol=8 * np.finfo(found.dtype).eps * np.abs(expected).max())


def test_projectors_are_the_products_of_directions():
    bases = directions(np.random.default_rng(1), 3000)
    along = np.empty((3000, 9))
    sliding_surface.tangent_projectors(bases.reshape(-1, 9), along)
    along = along.reshape(-1, 3, 3)
    close(along, bases @ bases.transpose(0, 2, 1))
    np.testing.assert_array_equal(along, along.transpose(0, 2, 1))


@pytest.mark.parametrize("dtype", PRECISIONS)
def test_diagonal_blocks_are_turned(dtype):
    rng = np.random.default_rng(2)
    turn, blocks = rng.normal(size=(2000, 3, 3)).astype(dtype), rng.normal(size=(2500, 6)).astype(dtype)
    slots = rng.permutation(2500)[:2000].astype(np.int32)
    expected = blocks.copy()
    expected[slots] = (turn.transpose(0, 2, 1) @ unpack_symmetric(blocks[slots]) @ turn).reshape(-1, 9)[:, UPPER]
    conjugate_gradients.turn_diagonal(turn.reshape(-1, 9), slots, blocks)
    close(blocks, expected)


@pytest.mark.parametrize("dtype", PRECISIONS)
def test_projected_diagonal_blocks_have_a_multiple_of_the_identity_across(dtype):
    rng = np.random.default_rng(3)
    bases, blocks = directions(rng, 2000), rng.normal(size=(2500, 6)).astype(dtype)
    along, slots = (bases @ bases.transpose(0, 2, 1)).astype(dtype), rng.permutation(2500)[:2000].astype(np.int32)
    blocks[slots[::7]] = 0  # nothing is known of their size: 1
    own = along @ unpack_symmetric(blocks[slots]) @ along
    size = np.abs(np.trace(own, axis1=1, axis2=2)) / np.trace(along, axis1=1, axis2=2)
    size[::7] = 1
    own += size[:, None, None] * (np.eye(3) - along)
    expected = blocks.copy()
    expected[slots] = own.reshape(-1, 9)[:, UPPER]
    conjugate_gradients.project_diagonal(along.reshape(-1, 9), slots, blocks)
    close(blocks, expected)
