"""Sides of planes on which hexes lie, compared with NumPy."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from hexmend_app.scene.geometry.plane_sides import centres_kept, touched
from tests.core.grids import grid, scrambled

MESH = grid(4, 3, 2)


def heights(points, normals):
    """x . normal of every point and plane, (n, k), every operation rounded on its own."""
    return sum(points[:, None, i] * normals[None, :, i] for i in range(3))


@given(st.integers(0, 2**32 - 1), st.integers(1, 6), st.booleans(), st.booleans())
def test_results_agree_with_numpy(seed, planes, notch, along_axes):
    random = np.random.default_rng(seed)
    points = MESH.points if along_axes else scrambled(MESH, 0.2, seed).points
    # Along axes planes go through nodes, and through centres.
    normals = np.eye(3)[random.integers(0, 3, planes)] if along_axes else random.normal(size=(planes, 3))
    offsets = random.integers(0, 9, planes) / 2 if along_axes else random.uniform(0, 3, planes)
    h = heights(points, normals)[MESH.hexes]  # (m, 8, k)

    kept = h.sum(axis=1) <= 8 * offsets
    expected = kept.any(axis=1) if notch else kept.all(axis=1)
    if not along_axes and (np.abs(h.sum(axis=1) - 8 * offsets) < 1e-9).any():
        return
    np.testing.assert_array_equal(centres_kept(points, MESH.hexes, normals, offsets, notch), expected)

    slack = 1e-12 * np.maximum(np.abs(heights(points, normals)).max(axis=0), np.abs(offsets))
    before, beyond = h.max(axis=1) < offsets - slack, h.min(axis=1) > offsets + slack
    hidden = (before if notch else beyond).any(axis=1)
    np.testing.assert_array_equal(
        touched(points, MESH.hexes, normals, offsets, notch), ~(before | beyond) & ~hidden[:, None]
    )
