"""Metric values are computed once and cached."""

import gc
import weakref

import numpy as np
import pytest

from hexmend import METRICS, Mesh, measure
from hexmend.energy import MeshEnergy
from hexmend.mesh.hexahedron import EDGES
from hexmend_app.state.mesh import metric_cache
from hexmend_app.state.mesh.inspection import describe_hex, describe_node
from hexmend_app.state.mesh.metric_cache import metric_values
from tests.core.grids import grid, scrambled

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
