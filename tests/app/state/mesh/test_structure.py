"""Irregular and sharp edges against brute force and on meshes whose structure is known."""

from collections import Counter, defaultdict

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from hexmend.gallery import make
from hexmend.mesh.hexahedron import EDGES, FACES
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.topology import Topology
from hexmend_app.state.mesh.structure import find_structure
from tests.core.grids import grid
from tests.core.mesh.topology.test_topology import loose

#: A tetrahedron cut into four hexes: corners, middles of edges and faces, and the centre, by the corners they belong to.
_PLACES = [
    *({k} for k in range(4)),
    *({a, b} for a in range(4) for b in range(a + 1, 4)),
    *({0, 1, 2, 3} - {k} for k in range(4)),
    {0, 1, 2, 3},
]


def tetrahedron():
    """Make four hexes around one node, three around each of its four edges to the centres of the sides."""
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float)
    points = np.array([corners[sorted(place)].mean(axis=0) for place in _PLACES])
    hexes = []
    for a in range(4):
        b, c, d = sorted((k for k in range(4) if k != a), reverse=a % 2 == 1)  # right-handed
        sets = ({a}, {a, b}, {a, b, c}, {a, c}, {a, d}, {a, b, d}, {0, 1, 2, 3}, {a, c, d})
        hexes.append([_PLACES.index(place) for place in sets])
    return Mesh(points, hexes)


def brute(topology):
    """Hexes around every edge, and edges of boundary faces, by sets."""
    hexes = topology.hexes.tolist()
    around = defaultdict(set)
    for h, nodes in enumerate(hexes):
        for a, b in EDGES.tolist():
            if nodes[a] != nodes[b]:
                around[tuple(sorted((nodes[a], nodes[b])))].add(h)
    faces = Counter(frozenset(nodes[k] for k in face) for nodes in hexes for face in FACES.tolist())
    outside = set()
    for nodes in hexes:
        for face in FACES.tolist():
            if faces[frozenset(nodes[k] for k in face)] == 1:
                outside |= {tuple(sorted((nodes[a], nodes[b]))) for a, b in zip(face, face[1:] + face[:1], strict=True)}
    return around, outside


@given(loose(), st.randoms())
def test_valences_are_the_hexes_around_each_edge_whatever_the_numbering(topology, random):
    order = list(range(topology.n))
    random.shuffle(order)
    topology = Topology(np.array(order, np.int32)[topology.hexes], topology.n)
    around, outside = brute(topology)
    edges = [tuple(edge) for edge in topology.edges.tolist()]
    assert edges == sorted(around)
    assert topology.edge_valence.tolist() == [len(around[edge]) for edge in edges]
    assert topology.edge_on_boundary.tolist() == [edge in outside for edge in edges]
    inside = [k for k, edge in enumerate(edges) if edge not in outside and len(around[edge]) != 4]
    assert topology.irregular_edges.tolist() == inside
    assert topology.irregular_boundary_edges.tolist() == [
        k for k, edge in enumerate(edges) if edge in outside and len(around[edge]) != 2
    ]


@given(st.tuples(*[st.integers(1, 4)] * 3))
def test_a_grid_is_regular_but_for_the_edges_of_its_box(size):
    mesh = grid(*size)
    topology = mesh.topology
    assert not len(topology.irregular_edges)
    assert not len(topology.irregular_nodes)
    assert len(topology.irregular_boundary_edges) == 4 * sum(size)
    assert set(topology.edge_valence[topology.irregular_boundary_edges].tolist()) == {1}
    found = find_structure(mesh)
    assert not len(found.boundary)  # a box wants one hex at its edges
    assert sorted(map(tuple, found.sharp.tolist())) == sorted(
        map(tuple, topology.edges[topology.irregular_boundary_edges].tolist())
    )


def test_five_blocks_meet_in_one_line_that_ends_on_the_boundary():
    mesh = make("five-side", size=60)  # so few that each layer is five blocks
    found = find_structure(mesh)
    assert len(found.interior) == 3  # one for each layer
    assert set(found.interior_valence.tolist()) == {5}
    np.testing.assert_allclose(mesh.points[found.interior][..., :2], 0, atol=1e-12)  # along the axis
    assert not len(found.nodes)
    assert not len(found.boundary)


def test_a_tetrahedron_of_four_hexes_has_an_irregular_node_where_four_edges_fork():
    mesh = tetrahedron()
    found = find_structure(mesh)
    assert found.nodes.tolist() == [14]
    assert sorted(map(tuple, found.interior.tolist())) == [(10, 14), (11, 14), (12, 14), (13, 14)]
    assert found.interior_valence.tolist() == [3] * 4
    # In the middle of each side three hexes meet, each with two edges there that are regular.
    assert not len(found.boundary)


def test_three_hexes_around_a_concave_edge_are_as_they_should_be_and_around_a_flat_one_are_not():
    mesh = grid(2, 2, 1)
    corner = Mesh(mesh.points, np.delete(mesh.hexes, 3, axis=0))
    topology = corner.topology
    (concave,) = topology.edges[(topology.edge_valence == 3) & topology.edge_on_boundary].tolist()
    assert concave in find_structure(corner).sharp.tolist()
    assert not len(find_structure(corner).boundary)
    points = corner.points.copy()
    angle = np.arctan2(points[:, 1] - 1, points[:, 0] - 1) % (2 * np.pi)
    angle = np.where(angle < np.pi / 4, angle + 2 * np.pi, angle)
    radius = np.hypot(points[:, 0] - 1, points[:, 1] - 1)
    turned = (angle - np.pi / 2) * (2 / 3) + np.pi / 2  # three right angles become two
    points[:, 0], points[:, 1] = radius * np.cos(turned), radius * np.sin(turned)
    flat = find_structure(Mesh(points, corner.hexes))
    assert flat.boundary.tolist() == [concave]
    assert flat.boundary_valence.tolist() == [3]


def test_a_hex_that_has_an_edge_twice_counts_once():
    mesh = grid(1)
    hexes = mesh.hexes.copy()
    hexes[0, 3] = hexes[0, 2]  # corners 2 and 3, of the edges 1-2 and 0-3, are one
    hexes[0, 0] = hexes[0, 1]
    topology = Topology(hexes, mesh.n_nodes)
    edge = sorted(hexes[0, [1, 2]].tolist())
    (at,) = np.flatnonzero((topology.edges == edge).all(axis=1))
    assert topology.edge_valence[at] == 1
    assert (topology.edges[:, 0] < topology.edges[:, 1]).all()
