"""Lengths of hexes: means of parallel edges, in the order of the hex's own numbering."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from hexmend.gallery import make
from hexmend.mesh.hexahedron import EDGES, UNIT_CUBE
from hexmend.mesh.mesh import Mesh
from hexmend.target.edge_lengths import edge_numbers, given_lengths
from tests.core.layers.stacks import renumbered, stack


@given(seed=st.integers(0, 100))
def test_lengths_follow_the_numbering_of_a_hex(seed):
    mesh = stack(4, 3, 5)
    turned, directions = renumbered(mesh, seed)
    expected = np.take_along_axis(given_lengths(mesh), directions, axis=1)
    np.testing.assert_allclose(given_lengths(turned), expected, rtol=1e-12)


def test_lengths_are_positive_where_a_hex_has_none():
    flat = Mesh(UNIT_CUBE * [1, 1, 0], [range(8)])
    assert (given_lengths(flat) > 0).all()
    mirrored = Mesh(UNIT_CUBE * [1, 2, -3], [range(8)])
    np.testing.assert_allclose(given_lengths(mirrored), [[1, 2, 3]])


def test_every_edge_of_a_hex_has_its_number():
    mesh = make("five-side", size=500)
    numbers = edge_numbers(mesh.topology)
    ends = np.sort(mesh.hexes[:, EDGES], axis=2)
    np.testing.assert_array_equal(mesh.topology.edges[numbers], ends)
