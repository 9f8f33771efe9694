"""Irregular and sharp edges against brute force and on meshes whose structure is known."""

import gc
import weakref
from collections import Counter, defaultdict

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend import METRICS, Mesh, measure
from hexmend.energy import MeshEnergy
from hexmend.gallery import make
from hexmend.mesh.hexahedron import EDGES, FACES
from hexmend.mesh.topology import Topology
from hexmend_app.state.mesh import metric_cache
from hexmend_app.state.mesh.inspection import describe_hex, describe_node
from hexmend_app.state.mesh.metric_cache import metric_values
from hexmend_app.state.mesh.structure import find_structure
from tests.core.grids import grid, scrambled
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


# Metric values are computed once and cached.


MESH = scrambled(grid(3), 0.4)


@pytest.mark.parametrize("name", METRICS)
def test_values_are_those_of_the_metric_and_cached(name):
    figures = measure(MESH.points, MESH.hexes)
    values = metric_values(name, MESH, figures)
    np.testing.assert_array_equal(values, METRICS[name].of(MESH.points, MESH.hexes, figures))
    assert metric_values(name, MESH, figures) is values


def test_other_points_have_other_values():
    other = scrambled(grid(3), 0.1)
    first = metric_values("skew", MESH, measure(MESH.points, MESH.hexes))
    assert (metric_values("skew", other, measure(other.points, other.hexes)) != first).any()


def test_three_metrics_are_cached_as_long_as_the_quality_lives():
    figures = measure(MESH.points, MESH.hexes)
    for name in METRICS:
        metric_values(name, MESH, figures)
    assert len(metric_cache.CACHE[figures]) == 3
    values = weakref.ref(metric_values("volume", MESH, figures))
    del figures
    gc.collect()
    assert values() is None


# Details of one hex and of one node.


def test_an_element_says_what_the_whole_mesh_says_of_it():
    mesh = scrambled(grid(4), 0.9, 1)
    figures = measure(mesh.points, mesh.hexes)
    for h in (0, 21, int(figures.q.argmin())):
        one = describe_hex(mesh, h)
        assert one.number == h
        np.testing.assert_array_equal(one.nodes, mesh.hexes[h])
        assert figures.q[h] == pytest.approx(one.corners.mean())
        for name, metric in METRICS.items():
            assert one.values[name] == pytest.approx(metric.values(mesh, figures)[h], rel=1e-9, abs=1e-6, nan_ok=True)
        assert one.inverted == figures.inverted[h]
        np.testing.assert_array_equal(one.fixed, mesh.fixed[one.nodes])
        shared = [len(set(one.nodes) & set(mesh.hexes[k])) if k >= 0 else 4 for k in one.neighbours]
        assert shared == [4] * 6


def test_a_node_says_what_the_mesh_says_of_it():
    mesh = scrambled(grid(4), 0.2, 1)
    pinned = np.zeros(mesh.n_nodes, bool)
    inner = np.flatnonzero(mesh.free)
    pinned[inner[3]] = True
    mesh = mesh.replace(pinned=pinned)
    energy = MeshEnergy(mesh)
    gradient = energy.gradient(energy.to_edge_units(mesh.points))
    for k, i in enumerate(energy.nodes):
        one = describe_node(mesh, int(i))
        assert one.kind == "free"
        np.testing.assert_array_equal(np.sort(one.ring), np.flatnonzero((mesh.hexes == i).any(axis=1)))
        edges = np.diff(mesh.points[mesh.hexes[one.ring]][:, EDGES], axis=2)
        units = np.linalg.norm(edges, axis=-1).mean() / mesh.mean_edge_length
        np.testing.assert_allclose(one.downhill, -gradient[k] * units, atol=1e-12)
        assert one.energy == pytest.approx(np.square(measure(mesh.points, mesh.hexes).eta[one.ring]).sum())
    assert describe_node(mesh, int(inner[3])).kind == "pinned"
    assert describe_node(mesh, int(inner[3])).pinned
    by_rule = mesh.replace(pinned=None, node_sets={"some": inner[3:4]}).with_rules(fix=("some",))
    assert describe_node(by_rule, int(inner[3])).kind == "fixed"
    assert (
        describe_node(mesh, 0).kind == describe_node(mesh.replace(pinned=mesh.topology.boundary), 0).kind == "boundary"
    )
    assert not describe_node(mesh, 0).pinned
    assert describe_node(mesh.replace(pinned=mesh.topology.boundary), 0).pinned
    tangled = scrambled(grid(4), 2.0, 1)
    one = describe_node(tangled, int(tangled.hexes[measure(tangled.points, tangled.hexes).inverted][0, 0]))
    assert one.energy == np.inf
    assert (one.downhill == 0).all()


def test_a_node_of_no_hex_is_unused_and_goes_nowhere():
    mesh = grid(1)
    one = describe_node(Mesh(np.concatenate([mesh.points, [[9.0, 9, 9]]]), mesh.hexes), 8)
    assert (one.kind, one.ring.size, one.energy, one.downhill.tolist()) == ("unused", 0, 0.0, [0, 0, 0])
    assert one.point.tolist() == [9, 9, 9]
