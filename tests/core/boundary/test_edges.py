"""Unique edges of faces, whatever their direction."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend.boundary.edges import SurfaceEdges
from tests.core.grids import grid


@given(st.integers(0, 2**31), st.integers(4, 40))
def test_edges_are_those_of_the_faces_each_once_in_the_order_of_their_nodes(seed, n):
    random = np.random.default_rng(seed)
    faces = np.array([random.permutation(n)[:4] for _ in range(12)], dtype=np.int32)
    edges = SurfaceEdges(faces, n)
    pairs = [tuple(sorted(map(int, (face[k], face[(k + 1) % 4])))) for face in faces for k in range(4)]
    assert list(map(tuple, edges.nodes.tolist())) == sorted(set(pairs))
    assert edges.count.tolist() == [pairs.count(tuple(pair)) for pair in edges.nodes.tolist()]
    assert edges.key.dtype == np.int64
    assert (np.diff(edges.key) > 0).all()
    np.testing.assert_array_equal(edges.keys_of(edges.nodes[:, ::-1]), edges.key)


def test_faces_of_a_solid_run_through_their_edges_in_opposite_directions():
    mesh = grid(3)
    edges = SurfaceEdges(mesh.topology.boundary_faces, mesh.n_nodes)
    assert (edges.count == 2).all()
    assert edges.opposed.all()
    assert (edges.neighbours[:, 0] != edges.neighbours[:, 1]).all()


@given(st.integers(0, 2**31), st.integers(3, 12), st.integers(3, 5))
def test_neighbours_of_an_edge_are_its_first_two_faces_and_opposed_where_they_run_against_each_other(seed, n, width):
    random = np.random.default_rng(seed)
    faces = random.integers(0, n, (15, width)).astype(np.int32)  # successive nodes may be equal
    sides = {}
    for number, face in enumerate(faces.tolist()):
        for one, other in zip(face, face[1:] + face[:1], strict=True):
            if one != other:
                sides.setdefault((min(one, other), max(one, other)), []).append((number, one))
    edges = SurfaceEdges(faces, n)
    assert list(map(tuple, edges.nodes.tolist())) == sorted(sides)
    for row, edge in enumerate(sorted(sides)):
        (one, start), (other, end) = sides[edge][0], sides[edge][:2][-1]
        assert (edges.count[row], *edges.neighbours[row]) == (len(sides[edge]), one, other)
        assert edges.opposed[row] == (start != end)


def test_there_are_no_edges_without_faces_and_a_node_that_does_not_exist_is_rejected():
    edges = SurfaceEdges(np.empty((0, 3), dtype=np.int32), 4)
    assert edges.nodes.shape == edges.neighbours.shape == (0, 2)
    assert edges.count.size == edges.key.size == edges.opposed.size == 0
    assert edges.fans.tolist() == [0, 0, 0, 0]
    for node in -1, 3:
        with pytest.raises(ValueError, match="out of range"):
            SurfaceEdges(np.array([[0, 1, node]], dtype=np.int32), 3)
