"""Details of one hex and of one node, and the order of the worst hexes."""

from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend.energy import MeshEnergy
from hexmend.mesh.hexahedron import EDGES
from hexmend.mesh.mesh import Mesh
from hexmend.quality import ElementQuality, describe_hex, describe_node, measure, rank_worst
from hexmend.quality.validity import Validity
from tests.core.grids import grid, scrambled


def test_an_element_says_what_the_whole_mesh_says_of_it():
    mesh = scrambled(grid(4), 0.9, 1)
    figures = measure(mesh.points, mesh.hexes)
    for h in (0, 21, int(figures.q.argmin())):
        one = describe_hex(mesh, h)
        assert one.number == h
        np.testing.assert_array_equal(one.nodes, mesh.hexes[h])
        assert one.values["q"] == figures.q[h] == pytest.approx(one.corners.mean())
        assert one.values["scaled-jacobian"] == figures.scaled_jacobian[h]
        assert one.inverted == figures.inverted[h]
        np.testing.assert_array_equal(one.fixed, mesh.fixed[one.nodes])
        shared = [len(set(one.nodes) & set(mesh.hexes[k])) if k >= 0 else 4 for k in one.neighbours]
        assert shared == [4] * 6


@given(st.integers(0, 2**32 - 1), st.integers(0, 40), st.sampled_from([1, -1]))
def test_the_worst_are_inverted_then_invalid_inside_then_the_lowest(seed, count, better):
    random = np.random.default_rng(seed)
    values, jacobian = random.integers(0, 6, (2, 30)) / 5.0
    sigma = random.choice([-1.0, 1.0], 30, p=[0.3, 0.7])
    inside = np.where(random.random(30) < 0.2, Validity.INVALID_INSIDE, Validity.VALID)
    validity = np.where(sigma <= 0, Validity.INVERTED, inside).astype(np.uint8)
    figures = ElementQuality(values, sigma, jacobian, values, validity)
    got = rank_worst(values, figures, count, better)
    order = [Validity.INVERTED, Validity.INVALID_INSIDE, Validity.VALID]
    everything = sorted(range(30), key=lambda h: (order.index(validity[h]), better * values[h], jacobian[h], h))
    assert got.tolist() == everything[:count]


def test_what_has_no_value_is_the_worst_whichever_way_is_better():
    values = np.array([0.5, np.nan, 3.0, np.inf])
    figures = ElementQuality(values, np.ones(4), np.zeros(4), values, np.zeros(4, np.uint8))
    assert rank_worst(values, figures, 4).tolist() == [1, 0, 2, 3]
    assert rank_worst(values, figures, 3, better=-1).tolist() == [1, 3, 2]
    assert np.isnan(values[1])  # not written into


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


@pytest.mark.parametrize(
    ("count", "levels"), [(0, 2), (1, 40), (7, 2), (100, 10**9), (2_999, 40), (3_000, 2), (4_000, 40)]
)
def test_of_many_hexes_the_worst_are_found_without_sorting_all(count, levels):
    random = np.random.default_rng(count)
    q, scaled = (random.integers(0, levels, 3_000) / levels for _ in range(2))
    order = np.lexsort((np.arange(3_000), scaled, q))
    valid = np.zeros(3_000, bool)
    figures = SimpleNamespace(q=q, scaled_jacobian=scaled, inverted=valid, invalid=valid)
    assert rank_worst(q, figures, count).tolist() == order[:count].tolist()
