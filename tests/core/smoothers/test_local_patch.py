"""Patches of several nodes, 5.2.5: what they are made of, and the Newton step of each."""

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend import METHODS, Laplacian, LocalPatch, Mesh, StoppingCriteria, gallery, measure, smooth
from hexmend.energy import MeshEnergy
from hexmend.kernels import local
from hexmend.kernels.local import Direction, NodeStepSettings
from hexmend.kernels.patches import sweep
from hexmend.smoothers.local.patch import partition_patches
from hexmend.smoothers.local.single_node import LocalDescent
from hexmend.smoothers.visit_order import ORDERS, VisitOrder
from tests.core.grids import grid, scrambled
from tests.core.smoothers.test_smoothers import after
from tests.core.threads import by_threads

SIZES = st.sampled_from([1, 2, 8, 27])
OVERLAPS = st.sampled_from([0, 1])


def hexes_at(mesh, nodes):
    """The hexes that any of some nodes is a corner of."""
    return np.flatnonzero(np.isin(mesh.hexes, nodes).any(axis=1))


def swept(mesh, patches, k, smoother, delta):
    """The points after the step of patch k alone, and how often its hexes were asked."""
    points = mesh.points.copy()
    step = NodeStepSettings(Direction.NEWTON, delta, smoother.norm, smoother.line_search)
    asked = sweep(points, patches.kernel_partition, np.array([0, 1], np.int32), np.array([k], np.int32), step)
    return points, asked


def part(mesh, patches, k):
    """Patch k as a mesh of its own in mean edge lengths: it, its nodes' numbers among all, and the unit."""
    used, hexes = np.unique(mesh.hexes[patches.chosen[k]], return_inverse=True)
    hexes = hexes.reshape(-1, 8)
    unit = Mesh(mesh.points[used], hexes).mean_edge_length
    pinned = ~np.isin(used, patches.nodes[k])
    return Mesh(mesh.points[used] / unit, hexes, pinned=pinned), used, unit


@given(st.tuples(*[st.integers(1, 5)] * 3), SIZES, OVERLAPS)
def test_patches_hold_each_free_node_and_know_their_hexes(size, nodes, overlap):
    mesh = grid(*size)
    patches, free = partition_patches(mesh, nodes, overlap), np.flatnonzero(mesh.free)
    cores = partition_patches(mesh, nodes, 0).nodes
    np.testing.assert_array_equal(np.sort(cores.items), free)  # each once
    assert (np.diff(cores.start) <= nodes).all()
    assert len(cores) == len(patches.nodes)
    for k in range(len(cores)):
        expected = cores[k]
        if overlap:
            expected = np.intersect1d(np.unique(mesh.hexes[hexes_at(mesh, cores[k])]), free)
        np.testing.assert_array_equal(patches.nodes[k], expected)
        np.testing.assert_array_equal(np.sort(patches.chosen[k]), hexes_at(mesh, patches.nodes[k]))
    for k in range(len(patches.chosen)):
        rows = slice(*patches.chosen.start[k : k + 2])
        np.testing.assert_array_equal(patches.hexes[rows], mesh.hexes[patches.chosen[k]])
        slots, own = patches.slots[rows], np.isin(patches.hexes[rows], patches.nodes[k])
        np.testing.assert_array_equal(slots >= 0, own)
        np.testing.assert_array_equal(patches.nodes[k][slots[own]], patches.hexes[rows][own])


@given(st.tuples(*[st.integers(2, 5)] * 3), SIZES, OVERLAPS)
def test_patches_of_a_colour_share_no_hex(size, nodes, overlap):
    patches = partition_patches(grid(*size), nodes, overlap)
    np.testing.assert_array_equal(np.sort(patches.colours.items), np.arange(len(patches.nodes)))
    for g in range(len(patches.colours)):
        chosen = np.concatenate([patches.chosen[k] for k in patches.colours[g]])
        assert np.unique(chosen).size == chosen.size


@given(st.integers(0, 2**32 - 1), st.sampled_from([1.0, 2.0, 3.5]))
def test_a_patch_of_one_node_is_visited_as_local_newton_does(seed, p):
    mesh = scrambled(grid(3), 0.1, seed)
    mesh = mesh.with_points(2.5 * mesh.points)
    if measure(mesh.points, mesh.hexes).n_inverted:
        return
    single = after(mesh, LocalPatch(patch=1, overlap=0, p=p))
    np.testing.assert_allclose(single, after(mesh, METHODS["local-nr"](p=p)), atol=1e-7)
    np.testing.assert_allclose(single, after(mesh, METHODS["local-mnr"](p=p)), atol=1e-7)


@given(st.integers(0, 2**32 - 1), st.sampled_from([8, 27, 64]), st.sampled_from([1.5, 2.0, 4.0]))
def test_a_step_is_newtons_for_the_nodes_of_the_patch(seed, size, p):
    mesh = scrambled(grid(5), 0.15, seed)
    mesh = mesh.with_points(0.3 * mesh.points)
    if measure(mesh.points, mesh.hexes).n_inverted:
        return
    patches, smoother = partition_patches(mesh, size, 0), LocalPatch(p=p)
    small, used, unit = part(mesh, patches, 0)
    energy = MeshEnergy(small, smoother.norm)
    scale = energy.unit  # 1 but for rounding
    x = small.points / scale
    hessian = energy.hessian(x).assembled(np.float64).matrix().toarray()
    if np.linalg.eigvalsh(hessian).min() <= 1e-9:
        return
    step = np.linalg.solve(hessian, -energy.gradient(x).ravel()).reshape(-1, 3)
    points, (energies, derivatives) = swept(mesh, patches, 0, smoother, 0.0)
    move = (points[used] - mesh.points[used])[small.free] / unit / scale
    count = len(patches.chosen[0])
    assert derivatives == count
    assert energies % count == 0
    alpha = smoother.backtrack_factor ** (energies // count - 1)
    np.testing.assert_allclose(move, alpha * step, atol=1e-8 * np.abs(step).max() + 1e-12)


@given(st.integers(0, 2**32 - 1), SIZES, OVERLAPS, st.sampled_from([1.0, 2.0, 5.0]), st.sampled_from([0.2, 0.7, 1.5]))
def test_no_patch_raises_its_energy_nor_moves_a_node_of_others(seed, size, overlap, p, amplitude):
    mesh = scrambled(grid(4), amplitude, seed)
    patches, smoother = partition_patches(mesh, size, overlap), LocalPatch(p=p)
    delta = smoother.delta_at(mesh, mesh.points)
    k = seed % len(patches.nodes)
    points, _ = swept(mesh, patches, k, smoother, delta)
    moved = np.flatnonzero((points != mesh.points).any(axis=1))
    assert np.isin(moved, patches.nodes[k]).all()
    small, used, unit = part(mesh, patches, k)
    energy = MeshEnergy(small, smoother.norm)
    before, now = energy.value(small.points, delta), energy.value(points[used] / unit, delta)
    assert now <= before * (1 + 1e-9) + 1e-12


@pytest.mark.parametrize(("size", "overlap"), [(1, 0), (8, 1), (64, 0), (216, 1)])
def test_a_tangled_cube_becomes_the_perfect_grid(size, overlap):
    mesh = gallery.make("cube", size=216, scramble=0.9, seed=2)
    assert measure(mesh.points, mesh.hexes).n_inverted > 20
    result = smooth(mesh, LocalPatch(patch=size, overlap=overlap), StoppingCriteria(tolerance=1e-7))
    assert result.after.inverted == 0
    assert result.after.q_min == pytest.approx(1, abs=1e-8)


# In what order sweeps visit the nodes, 5.2.6: each once, and what comes of it is what visiting one by one comes to.


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
    mesh = gallery.make("bridge-sharp", size=2048)
    np.testing.assert_array_equal(*by_threads(lambda: after(mesh, METHODS["local-nr"](order=order), 3)))


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
    for number in range(2):
        for i in sequence(points.copy(), number):
            points[i] = points[mesh.topology.rings[i]].mean(axis=0)
    np.testing.assert_allclose(after(mesh, Laplacian(order=order), 2), points, rtol=1e-13)
