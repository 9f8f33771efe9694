"""Unique edges of faces, whatever their direction."""

import numpy as np
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
