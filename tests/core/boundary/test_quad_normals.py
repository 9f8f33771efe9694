"""Normals of the surface at the quads of a sliding boundary."""

import numpy as np
import pytest

from hexmend.boundary import SkinSurface, SlidingBoundary
from hexmend.boundary.sliding.quad_normals import QuadNormals
from tests.core.boundary.solids import ball, cylinder, slid
from tests.core.smoothers.test_sliding_on_surface import skin_of


def centres(mesh, sliding):
    return mesh.points[sliding.boundary.faces].mean(axis=1)


def test_on_a_ball_they_are_radial_wherever_nodes_slide():
    mesh = ball(6)
    sliding = SlidingBoundary(mesh)
    normals = QuadNormals(sliding)
    for there in mesh, slid(mesh, 0.4, 1):
        radial = centres(there, sliding)
        radial /= np.linalg.norm(radial, axis=1, keepdims=True)
        found = normals(there.points)
        np.testing.assert_allclose(np.linalg.norm(found, axis=1), 1)
        assert np.einsum("fi,fi->f", found, radial).min() > 0.99


def test_quads_at_an_edge_have_the_normal_of_their_own_patch():
    mesh = cylinder(32, 4)
    sliding = SlidingBoundary(mesh)
    found, middle = QuadNormals(sliding)(mesh.points), centres(mesh, sliding)
    top = middle[:, 2] > 1 - 1e-9
    np.testing.assert_allclose(found[top], [[0, 0, 1]] * top.sum(), atol=1e-12)
    side = (middle[:, 2] > 1e-9) & ~top
    assert np.abs(found[side, 2]).max() < 1e-12


@pytest.mark.parametrize("reversed_", [False, True])
def test_the_triangles_of_a_target_may_face_either_way(reversed_):
    skin = skin_of(ball(10))
    if reversed_:
        skin = SkinSurface(skin.points, np.ascontiguousarray(skin.faces[:, ::-1]), "part.stl")
    mesh = ball(4).sliding_on(skin)
    sliding = SlidingBoundary(mesh)
    found = QuadNormals(sliding)(sliding.mesh.points)
    assert np.einsum("fi,fi->f", found, centres(mesh, sliding)).min() > 0.8
