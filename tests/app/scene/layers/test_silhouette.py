"""Sharp edges, and the decision whether they show the shape of a body."""

import numpy as np
import pytest

from hexmend_app.scene.layers.silhouette import form_lines
from hexmend_app.state.mesh.structure import sharp_edges
from tests.core.grids import grid


@pytest.mark.parametrize("size", [(1, 1, 1), (3, 2, 4)])
def test_a_box_has_twelve_sharp_lines(size):
    mesh = grid(*size)
    edges = sharp_edges(mesh.points, mesh.topology.boundary_faces)
    assert len(edges) == 4 * sum(size)
    ends = mesh.points[edges]
    on_sides = ((ends == 0) | (ends == size)).all(axis=1)  # by axis: on the same two sides with both ends
    assert (on_sides.sum(axis=1) >= 2).all()
    assert form_lines(edges)


def test_sharp_edges_depend_on_the_angle():
    mesh = grid(2, 1, 1)
    points = mesh.points.copy()
    points[points[:, 0] == 2, 2] += np.tan(np.radians(40))
    faces = mesh.topology.boundary_faces
    assert len(sharp_edges(points, faces, 39)) == len(sharp_edges(points, faces, 41)) + 2


def test_sharp_edges_of_a_ball_do_not_form_lines():
    mesh = grid(6)
    p = mesh.points / 3 - 1
    size = np.linalg.norm(p, axis=1, keepdims=True)
    ball = p * np.abs(p).max(axis=1, keepdims=True) / np.maximum(size, 1e-9)
    assert not form_lines(sharp_edges(ball, mesh.topology.boundary_faces))
