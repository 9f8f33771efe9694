"""Topology against counts known by formula and against brute force."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from hexmend import Mesh, MeshError
from hexmend.mesh.topology import Topology
from tests.core.grids import grid

SIZES = st.tuples(*[st.integers(1, 4)] * 3)


@given(SIZES)
def test_counts_of_a_grid(size):
    nx, ny, nz = size
    mesh = grid(nx, ny, nz)
    topology = mesh.topology
    assert len(topology.boundary_faces) == 2 * (nx * ny + ny * nz + nz * nx)
    assert mesh.free.sum() == (nx - 1) * (ny - 1) * (nz - 1)
    edges = nx * (ny + 1) * (nz + 1) + ny * (nx + 1) * (nz + 1) + nz * (nx + 1) * (ny + 1)
    assert len(topology.edges) == edges
    assert topology.n_nonmanifold_faces == 0


@given(SIZES)
def test_colours_part_the_chosen_nodes_and_never_meet_in_a_hex(size):
    mesh = grid(*size)
    chosen = np.arange(mesh.n_nodes) % 5 != 0
    groups = mesh.topology.colouring(chosen)
    assert sorted(groups.items.tolist()) == np.flatnonzero(chosen).tolist()
    for k in range(len(groups)):
        within = np.isin(mesh.hexes, groups[k]).sum(axis=1)
        assert within.max(initial=0) <= 1


def test_faces_of_three_hexes_or_of_two_on_the_same_side_count_as_boundary_and_are_reported():
    mesh = grid(2, 1, 1)
    hexes = np.vstack([mesh.hexes, mesh.hexes[:1]])
    topology = Mesh(mesh.points, hexes).topology
    assert (
        topology.n_nonmanifold_faces == 3 + 2 * 5
    )  # the inner face, and the outer ones of the hex that is there twice
    assert (topology.face_neighbours == -1).all()
    assert topology.boundary[mesh.points[:, 0] == 1].all()


@given(st.integers(1, 12), st.integers(8, 60), st.integers(0, 2**32 - 1))
def test_parts_are_the_components_of_the_graph_of_nodes_that_share_a_hex(m, n, seed):
    hexes = np.random.default_rng(seed).integers(n, size=(m, 8))
    topology = Mesh(np.zeros((n, 3)), hexes).topology
    graph = coo_array((np.ones(8 * m), (np.repeat(hexes[:, 0], 8), hexes.ravel())), shape=(n, n))
    assert topology.parts == connected_components(graph, directed=False)[0] - np.count_nonzero(~topology.used)


@st.composite
def loose(draw):
    """Take some hexes of a grid, in any order."""
    mesh = grid(*draw(SIZES))
    chosen = draw(st.lists(st.sampled_from(range(mesh.n_hexes)), min_size=1, unique=True))
    return Topology(np.ascontiguousarray(mesh.hexes[chosen]), mesh.n_nodes)


def closed(size):
    """Make a periodic grid without boundary faces."""
    number = np.arange(np.prod(size)).reshape(size)
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
    columns = [np.roll(number, [-c for c in corner], axis=(0, 1, 2)).ravel() for corner in corners]
    return np.column_stack(columns).astype(np.int32)


@given(loose())
def test_layers_are_the_distances_from_the_hexes_of_the_boundary(topology):
    neighbours = topology.face_neighbours
    expected = np.where((neighbours < 0).any(axis=1), 0, -1)
    for layer in range(len(neighbours)):
        beside = (expected[neighbours] == layer) & (neighbours >= 0)
        expected[(expected < 0) & beside.any(axis=1)] = layer + 1
    assert topology.layers.dtype == np.int32
    assert topology.layers.tolist() == expected.tolist()


@given(loose(), st.integers(0, 4), st.data())
def test_rings_are_hexes_that_share_nodes_again_and_again(topology, rings, data):
    hexes = data.draw(st.lists(st.integers(0, len(topology.hexes) - 1), max_size=3))
    expected = np.isin(np.arange(len(topology.hexes)), hexes)
    for _ in range(rings):
        expected = np.isin(topology.hexes, topology.hexes[expected]).any(axis=1)
    assert topology.hexes_around(hexes, rings).tolist() == expected.tolist()


@pytest.mark.parametrize("wrong", [-1, 8])
def test_there_is_no_ring_of_a_hex_that_does_not_exist(wrong):
    with pytest.raises(MeshError, match=f"has {wrong} at .*: expected numbers from 0 to 7"):
        grid(2).topology.hexes_around([0, wrong], 1)
