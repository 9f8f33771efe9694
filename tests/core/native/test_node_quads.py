"""The energy of the boundary quads at a node in the kernels, against that of all quads in numpy."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend.energy.element_blocks import ElementBlocks
from hexmend.energy.norm import ObjectiveNorm
from hexmend.energy.quads.surface_term import SurfaceTerm
from tests.core.native.extension import extension

kernels = extension().node_quads

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
    return kernels.quads_at_node(
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
