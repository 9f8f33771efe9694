"""Incidence kernels against plain NumPy, over meshes of many chunks, of no hexes, and of hexes that are none."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend import Mesh, kernels
from hexmend.energy.sparsity import BlockSparsity
from hexmend.kernels import incidence, sparsity, structure
from hexmend.mesh.hexahedron import EDGES, FACES
from hexmend.mesh.topology import Topology
from tests.core.grids import grid


@pytest.fixture(params=[1, 3], autouse=True, scope="module")
def threads(request):
    before = kernels.threads()
    kernels.set_threads(request.param)
    yield request.param
    kernels.set_threads(before)


def shuffled(nx, ny, nz, seed=0):
    """A grid whose nodes are numbered anyhow."""
    mesh = grid(nx, ny, nz)
    order = np.random.default_rng(seed).permutation(mesh.n_nodes)
    points = np.empty_like(mesh.points)
    points[order] = mesh.points
    return Mesh(points, order[mesh.hexes])


MESH = shuffled(14, 13, 12)


def by_node(pairs, n):
    """Pairs of numbers as compressed rows, each pair once."""
    pairs = np.unique(pairs, axis=0)
    return np.searchsorted(pairs[:, 0], np.arange(n + 1)), pairs[:, 1]


def test_node_corners_are_the_places_of_each_node():
    rows = MESH.topology.node_corners
    order = np.argsort(MESH.hexes.ravel(), kind="stable")
    np.testing.assert_array_equal(rows.items, order)
    np.testing.assert_array_equal(rows.start, np.searchsorted(MESH.hexes.ravel()[order], np.arange(MESH.n_nodes + 1)))


def test_rings_and_edges_are_those_of_the_hexes():
    topology = Topology(MESH.hexes, MESH.n_nodes)
    edges = MESH.hexes[:, EDGES].reshape(-1, 2)
    start, ring = by_node(np.vstack([edges, edges[:, ::-1]]), MESH.n_nodes)
    np.testing.assert_array_equal(topology.rings.start, start)
    np.testing.assert_array_equal(topology.rings.items, ring)
    ends, valence = np.unique(np.sort(edges, axis=1), axis=0, return_counts=True)
    np.testing.assert_array_equal(topology.edges, ends)
    np.testing.assert_array_equal(topology.edge_valence, valence)
    assert topology.edge_on_boundary.dtype == bool
    np.testing.assert_array_equal(topology.edge_on_boundary, valence < 4)


def test_hexes_behind_faces_are_those_with_the_same_nodes():
    topology = Topology(MESH.hexes, MESH.n_nodes)
    faces = np.sort(MESH.hexes[:, FACES].reshape(-1, 4), axis=1)
    order = np.lexsort(faces.T)
    same = (faces[order[1:]] == faces[order[:-1]]).all(axis=1)
    expected = np.full(faces.shape[0], -1)
    one, other = order[1:][same], order[:-1][same]
    expected[one], expected[other] = other // 6, one // 6
    np.testing.assert_array_equal(topology.face_neighbours.ravel(), expected)
    assert topology.n_nonmanifold_faces == 0


@given(st.integers(1, 8), st.integers(2, 12), st.integers(0, 2**32 - 1))
def test_faces_of_collapsed_hexes_are_paired_by_their_nodes(m, n, seed):
    hexes = np.random.default_rng(seed).integers(n, size=(m, 8), dtype=np.int32)
    hexes = hexes[hexes[:, 5] != hexes[:, 7]]  # three equal nodes at the end: a cell of another kind
    topology = Topology(hexes, n)
    faces = [tuple(sorted(face)) for h in hexes for face in h[FACES].tolist()]
    orders = hexes[:, FACES].reshape(-1, 4).tolist()
    overlapping = 0
    for i, face in enumerate(faces):
        partners = [j for j, other in enumerate(faces) if j != i and other == face]
        inner = len(partners) == 1 and opposed(orders[i], orders[partners[0]])
        overlapping += bool(partners) and not inner
        assert topology.face_neighbours.ravel()[i] == (partners[0] // 6 if inner else -1)
    assert topology.n_nonmanifold_faces == overlapping


def opposed(one, other):
    """Return True if a list of nodes is the other one, backwards from any node of it."""
    return any(one == (other[k:] + other[:k])[::-1] for k in range(len(other)))


def test_more_than_64_colours_are_given_as_greedily_as_the_first():
    hexes = np.random.default_rng(0).integers(90, size=(4000, 8), dtype=np.int32)
    corners = Topology(hexes, 90).node_corners
    colour = incidence.greedy_colours(corners.start, corners.items, np.ones(90, bool))
    together = np.zeros((90, 90), bool)
    together[hexes[:, :, None], hexes[:, None, :]] = True
    np.fill_diagonal(together, False)
    expected = np.full(90, -1)
    for i in range(90):
        expected[i] = min(set(range(90)) - set(expected[together[i]].tolist()))
    np.testing.assert_array_equal(colour, expected)
    assert colour.max() > 64


def test_blocks_of_a_hessian_are_the_pairs_of_free_nodes_that_share_a_hex():
    at = BlockSparsity(MESH, parts=2)
    rows, columns = at.row_start, at.columns
    pairs = at.slots[:, [(a, b) for a in range(8) for b in range(8)]].reshape(-1, 2)
    pairs = pairs[(pairs[:, 0] >= 0) & (pairs[:, 1] > pairs[:, 0])]
    start, expected = by_node(pairs, at.nodes.size)
    np.testing.assert_array_equal(rows, start)
    np.testing.assert_array_equal(columns, expected)


def test_hexes_of_shares_are_those_at_their_slots_and_the_last_shares_are_kept():
    fixed = np.zeros(MESH.n_nodes, dtype=bool)
    fixed[MESH.hexes[:3]] = True  # hexes that are in no share
    at = BlockSparsity(MESH.with_fixed(fixed), parts=2)
    slots = at.slots
    assert (slots[:3] == -1).all()
    for count in (1, 2, 5, 2):
        shares = at.shares(count)
        assert at.shares(count) is shares
        np.testing.assert_array_equal(at.slots, slots)


def test_no_hexes_are_no_trouble():
    hexes = np.empty((0, 8), np.int32)
    for n in (0, 5):
        start, corners = incidence.node_corners(hexes, n)
        assert start.tolist() == [0] * (n + 1)
        neighbours, crowded = incidence.face_neighbours(hexes, start, corners)
        assert neighbours.shape == (0, 6)
        assert crowded == 0
        assert incidence.node_rings(hexes, start, corners)[1].size == 0
        assert incidence.greedy_colours(start, corners, np.zeros(n, bool)).tolist() == [-1] * n
        ends, valence, outside = structure.edges(hexes, start, corners, neighbours)
        assert (ends.shape, valence.size, outside.dtype) == ((0, 2), 0, bool)
    rows, columns = sparsity.pattern(hexes, np.empty(0, np.int32), start, corners)
    assert (rows.tolist(), columns.size) == ([0], 0)


def test_more_items_than_there_are_numbers_for_are_refused_before_they_are_written():
    hexes = grid(2, 1, 1).hexes
    start, corners = incidence.node_corners(hexes, 12)
    neighbours, _ = incidence.face_neighbours(hexes, start, corners)
    slots = np.ascontiguousarray(hexes)
    for make, items in [
        (lambda most: incidence.node_rings(hexes, start, corners, most), 40),
        (lambda most: structure.edges(hexes, start, corners, neighbours, most), 20),
        (lambda most: sparsity.pattern(slots, np.arange(12, dtype=np.int32), start, corners, max_items=most), 50),
    ]:
        make(items)
        with pytest.raises(OverflowError, match=f"there are {items} items: expected {items - 1} at most"):
            make(items - 1)
