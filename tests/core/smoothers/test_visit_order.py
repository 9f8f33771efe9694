"""In what order sweeps visit the nodes, 5.2.6: each once, and what comes of it is what visiting one by one comes to."""

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend import METHODS, Laplacian, kernels, measure
from hexmend.gallery import make
from hexmend.kernels import local
from hexmend.smoothers.local.single_node import LocalDescent
from hexmend.smoothers.visit_order import ORDERS, VisitOrder
from tests.core.grids import grid, scrambled
from tests.core.smoothers.test_smoothers import after

LOCAL = [name for name, method in METHODS.items() if issubclass(method, LocalDescent)]


def one_by_one(mesh, smoother, nodes):
    """The points after one node after another was visited."""
    points, delta = mesh.points.copy(), smoother.delta_at(mesh, mesh.points)
    for node in nodes:
        star = mesh.topology.node_corners[node]
        step = local.recorded_step(points, mesh.hexes, star, smoother.step_settings(delta))
        if step.status is local.StepStatus.MOVED:
            points[node] = step.place
    return points


def sharing(mesh):
    """Pairs of nodes that share a hex."""
    return {(int(a), int(b)) for a, b in itertools.permutations(range(8), 2) for a, b in mesh.hexes[:, [a, b]]}


@given(st.sampled_from(sorted(ORDERS)), st.integers(0, 5), st.tuples(*[st.integers(1, 4)] * 3), st.integers(0, 99))
def test_each_order_visits_each_free_node_once(order, sweep, size, seed):
    mesh = scrambled(grid(*size), 0.3, seed)
    visits = VisitOrder(mesh, order)
    nodes = visits.sequence(mesh.points, sweep)
    np.testing.assert_array_equal(np.sort(nodes), np.flatnonzero(mesh.free))
    np.testing.assert_array_equal(np.sort(visits.groups(mesh.points, sweep).items), np.sort(nodes))


@given(st.permutations(range(27)), st.integers(0, 27))
def test_nodes_of_a_wavefront_share_no_hex_and_neighbours_keep_their_order(nodes, count):
    mesh = grid(2)
    sequence = np.array(nodes[:count], np.int32)
    groups = mesh.topology.wavefronts(sequence)
    group = {int(node): k for k in range(len(groups)) for node in groups[k]}
    assert sorted(group) == sorted(sequence.tolist())
    pairs = sharing(mesh)
    for first, later in itertools.combinations(sequence.tolist(), 2):
        assert (first, later) not in pairs or group[first] < group[later]


@given(
    st.sampled_from(LOCAL),
    st.sampled_from(sorted(ORDERS)),
    st.integers(0, 99),
    st.sampled_from([0.2, 0.8]),
    st.integers(1, 3),
)
def test_a_sweep_is_the_visit_of_one_node_after_another(name, order, seed, amplitude, steps):
    mesh = scrambled(grid(4), amplitude, seed)
    smoother = METHODS[name](order=order, steps_per_node=steps)
    expected = one_by_one(mesh, smoother, ORDERS[order](mesh)(mesh.points, 0).repeat(steps))
    np.testing.assert_array_equal(after(mesh, smoother), expected)


@pytest.mark.parametrize("order", ["random", "worst-first"])
def test_threads_do_not_matter(order):
    mesh = make("bridge-sharp", size=2048)
    most = kernels.threads()
    expected = after(mesh, METHODS["local-nr"](order=order), 3)
    try:
        kernels.set_threads(1 if most > 1 else 2)
        np.testing.assert_array_equal(after(mesh, METHODS["local-nr"](order=order), 3), expected)
    finally:
        kernels.set_threads(most)


def test_natural_and_reverse_are_by_number():
    mesh = grid(4)
    free = np.flatnonzero(mesh.free)
    np.testing.assert_array_equal(ORDERS["natural"](mesh)(mesh.points, 0), free)
    np.testing.assert_array_equal(ORDERS["reverse"](mesh)(mesh.points, 0), free[::-1])


def test_inward_goes_from_level_to_level():
    mesh = grid(6)
    distance = np.minimum(mesh.points, 6 - mesh.points).min(axis=1)  # edges to the boundary
    np.testing.assert_array_equal(mesh.topology.levels(mesh.fixed), distance)
    there = distance[ORDERS["inward"](mesh)(mesh.points, 0)]
    assert (np.diff(there) >= 0).all()
    assert (there[0], there[-1]) == (1, 3)
    back = distance[ORDERS["outward"](mesh)(mesh.points, 0)]
    assert (np.diff(back) <= 0).all()
    sequence = ORDERS["alternating"](mesh)
    np.testing.assert_array_equal(distance[sequence(mesh.points, 0)], there)
    np.testing.assert_array_equal(distance[sequence(mesh.points, 1)], back)


def test_random_is_another_in_each_sweep_and_the_same_in_each_run():
    mesh = grid(5)
    sequence = ORDERS["random"](mesh)
    assert (sequence(mesh.points, 0) != sequence(mesh.points, 1)).any()
    np.testing.assert_array_equal(sequence(mesh.points, 3), ORDERS["random"](mesh)(mesh.points, 3))


@given(st.integers(0, 2**32 - 1))
def test_worst_first_is_by_the_least_quality_at_a_node(seed):
    mesh = scrambled(grid(4), 0.5, seed)
    q = measure(mesh.points, mesh.hexes).q
    least = [q[mesh.topology.node_corners[i] // 8].min() for i in ORDERS["worst-first"](mesh)(mesh.points, 0)]
    assert (np.diff(least) >= 0).all()


@pytest.mark.parametrize("order", sorted(ORDERS))
def test_laplacian_in_place_keeps_the_order(order):
    mesh = scrambled(grid(4), 0.3)
    points = mesh.points.copy()
    sequence = ORDERS[order](mesh)
    for sweep in range(2):
        for i in sequence(points.copy(), sweep):
            points[i] = points[mesh.topology.rings[i]].mean(axis=0)
    np.testing.assert_allclose(after(mesh, Laplacian(order=order), 2), points, rtol=1e-13)
