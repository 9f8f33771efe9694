"""Unique edges of faces, whatever their direction."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend.boundary.edges import SurfaceEdges


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
