"""Topology against counts known by formula and against brute force."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from hexmend import Mesh, MeshError
from hexmend.arrays import BLOCK
from hexmend.mesh.topology import Topology
from hexmend.mesh.topology.close_pairs import close_pairs
from hexmend.mesh.topology.components import any_of_rows, components, components_of_cells
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


# Connected components of items and of cells.


graphs = st.integers(1, 12).flatmap(
    lambda n: st.tuples(st.just(n), st.lists(st.tuples(*[st.integers(0, n - 1)] * 2), max_size=20))
)


def of_scipy(n, links):
    graph = coo_array((np.ones(len(links), np.int8), links.T), (n, n))
    return connected_components(graph, directed=False)[1]


@given(graphs)
def test_components_are_numbered_in_the_order_of_their_lowest_items(graph):
    n, links = graph[0], np.array(graph[1], np.int64).reshape(-1, 2)
    np.testing.assert_array_equal(components(n, links), of_scipy(n, links))


def test_a_row_connects_all_its_items_and_nothing_connects_none():
    assert components(6, np.array([[5, 2, 4]])).tolist() == [0, 1, 2, 3, 2, 2]
    assert components(3).tolist() == [0, 1, 2]
    assert components(0, np.empty((0, 8), np.int32)).tolist() == []


def test_cells_are_numbered_in_the_order_of_their_first_and_connected_by_others():
    cells, others = np.array([[7, 8], [0, 1], [8, 9], [2, 3]]), np.array([[1, 4, 2]])
    assert components_of_cells(10, cells).tolist() == [0, 1, 0, 2]
    assert components_of_cells(10, cells, others).tolist() == [0, 1, 0, 1]


# Pairs of points at one position, against all distances and against a tree.


def as_set(pairs):
    return {tuple(pair) for pair in pairs.tolist()}


@pytest.mark.parametrize(("seed", "scale"), [(0, 1e-3), (1, 1.0), (2, 1e6)])
def test_pairs_are_those_of_a_tree(seed, scale):
    rng = np.random.default_rng(seed)
    lattice = np.stack(np.meshgrid(*3 * [np.arange(8.0)], indexing="ij"), axis=-1).reshape(-1, 3)
    near = lattice[rng.permutation(len(lattice))[:40]] + rng.uniform(-1, 1, (40, 3)) * 1e-6
    points = scale * np.concatenate([lattice, near, near[:5]])
    found = close_pairs(points, scale * 1e-6)
    assert as_set(found) == as_set(cKDTree(points).query_pairs(scale * 1e-6, output_type="ndarray"))
    assert len(found) > 5


@pytest.mark.parametrize("count", [0, 1, 2, 100])
def test_points_that_are_all_at_one_position_are_all_pairs(count):
    assert len(as_set(close_pairs(np.ones((count, 3)), 0.0))) == count * (count - 1) // 2


def test_points_beside_each_other_along_a_plane_are_no_pairs():
    rng = np.random.default_rng(0)
    assert close_pairs(rng.uniform(size=(10_000, 3)), 1e-9).shape == (0, 2)


# Marks of rows, however wide and many they are.


@pytest.mark.parametrize(("width", "count"), [*((width, 50) for width in range(1, 10)), (8, 0), (3, BLOCK + 1)])
def test_a_row_is_marked_if_one_of_its_numbers_is(width, count):
    random = np.random.default_rng(width)
    marks, rows = random.random(200) < 0.2, random.integers(0, 200, (count, width)).astype(np.int32)
    found = any_of_rows(marks, rows)
    assert found.dtype == bool
    np.testing.assert_array_equal(found, marks[rows].any(axis=1))
