"""Kernels that take hexes side by side, against the plain loops of one hex; tails of a block included."""

import gc
import sys

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend.boundary import SlidingBoundary
from hexmend.energy import SQUARES, BlockSparsity, MeshEnergy, ObjectiveNorm, energies
from hexmend.energy.hex_energy import pack_corners
from hexmend.gallery import make
from hexmend.kernels import LANES, element_step, laplacian, local, objective, step_limits, structure
from hexmend.kernels.hex_mesh import HexMesh
from hexmend.kernels.line_search import LineSearch
from hexmend.mesh.hexahedron import CORNER_TETRAHEDRA
from hexmend.target.sheets import Sheets, edge_numbers
from tests.core.grids import grid, scrambled
from tests.core.native import extension
from tests.core.threads import by_threads

scalar_reference = extension.scalar_reference()

#: One hex, a part of a block, one block and a hex, more than a thread takes at a time.
COUNTS = [1, LANES - 1, LANES + 1, 256 + 12]


def some(count, amplitude, seed):
    """`count` hexes of a scrambled grid, and its points in mean edge lengths."""
    mesh = scrambled(grid(7), amplitude, seed)
    return mesh.points / mesh.mean_edge_length, mesh.hexes[:count]


cases = {
    "count": st.sampled_from(COUNTS),
    "case": st.sampled_from([(0.15, 0.0), (0.15, 0.1), (0.9, 0.02), (3.0, 0.5)]),
    "p": st.sampled_from([1.0, 2.0, 3.5]),
    "seed": st.integers(0, 2**32 - 1),
    "offset": st.sampled_from([1.0, 0.0]),
    "share": st.sampled_from([0.0, 0.02, 0.5]),
}


def some_left_out(count, share, seed):
    """A bit for each tetrahedron of each hex, set for about this share of them."""
    bits = np.random.default_rng(seed + 1).uniform(size=(count, 8)) < share
    return pack_corners(bits)


@given(**cases)
def test_energy_and_gradient_are_those_of_the_plain_loop(count, case, p, offset, seed, share):
    points, hexes = some(count, case[0], seed)
    delta, omitted = case[1], some_left_out(count, share, seed)
    shares, expected = np.full((2, count, 8, 3), np.nan)
    eta, plain_eta = np.full((2, count), np.nan)
    objective.gradient(points, hexes, delta, ObjectiveNorm(p, offset), omitted, shares)
    scalar_reference.gradient(points, hexes, delta, ObjectiveNorm(p, offset), omitted, expected)
    objective.energies(points, hexes, delta, offset, omitted, eta)
    scalar_reference.energies(points, hexes, delta, offset, omitted, plain_eta)
    np.testing.assert_allclose(eta, plain_eta, rtol=1e-12, atol=1e-14)
    for h in range(count):
        np.testing.assert_allclose(shares[h], expected[h], rtol=1e-11, atol=1e-12 * np.abs(expected[h]).max())


@given(**cases)
def test_the_product_is_that_of_the_plain_loop(count, case, p, offset, seed, share):
    points, hexes = some(count, case[0], seed)
    delta, omitted = case[1], some_left_out(count, share, seed)
    values = np.random.default_rng(seed).normal(size=(len(points) // 2, 3))
    slots = np.where(hexes % 2 == 0, hexes // 2, -1).astype(np.int32)  # odd nodes are fixed
    slots[slots >= len(values)] = -1
    shares, expected = np.full((2, count, 8, 3), np.nan)
    objective.hessian_product(points, hexes, slots, values, delta, ObjectiveNorm(p, offset), omitted, shares)
    scalar_reference.hessian_product(points, hexes, slots, values, delta, ObjectiveNorm(p, offset), omitted, expected)
    for h in range(count):
        size = max(np.abs(expected[h]).max(), 1e-300)
        np.testing.assert_allclose(shares[h], expected[h], rtol=1e-10, atol=1e-11 * size)


@pytest.mark.parametrize("direction", local.Direction)
@given(seed=st.integers(0, 2**32 - 1), case=cases["case"], p=cases["p"], offset=cases["offset"])
def test_a_local_sweep_is_that_of_the_plain_loop(direction, seed, case, p, offset):
    mesh = scrambled(grid(4), *(case[0], seed))
    colours, norm = mesh.topology.colouring(mesh.free), ObjectiveNorm(p, offset)
    settings = local.NodeStepSettings(direction, case[1], norm, LineSearch(max_backtracks=60))
    moved, expected = mesh.points.copy(), mesh.points.copy()
    for sweep, points in ((local.sweep, moved), (scalar_reference.sweep, expected)):
        sweep(points, mesh.topology.hex_mesh, colours.start, colours.items, settings)
    np.testing.assert_allclose(moved, expected, atol=1e-7 * mesh.mean_edge_length)


def test_flat_and_inverted_hexes_have_infinite_energy_and_no_other_has():
    mesh = scrambled(grid(5), 0.1)
    points = mesh.points.copy()
    points[mesh.hexes[7, 4:]] = points[mesh.hexes[7, :4]]  # flat: every corner's sigma is exactly zero
    eta = energies(points, mesh.hexes)
    touched = np.isin(mesh.hexes, mesh.hexes[7, 4:]).any(axis=1)
    assert eta[7] == np.inf
    assert np.isfinite(eta[~touched]).all()
    assert np.isfinite(energies(points, mesh.hexes, 0.01)).all()


@given(st.integers(0, 2**32 - 1), st.sampled_from([0.0, 0.05]))
def test_what_is_left_out_counts_as_perfect_and_moves_nothing(seed, delta):
    points, hexes = some(40, 0.2, seed)
    whole = np.full(40, 0xFF, np.uint8)
    blocks = np.full((40, 8, 3), np.nan)
    assert (energies(points, hexes, delta, whole) == 0).all()
    objective.gradient(points, hexes, delta, SQUARES, whole, blocks)
    assert (blocks == 0).all()
    one = np.full(40, 0b100, np.uint8)
    edges = points[hexes[:, [1, 6, 3]]] - points[hexes[:, [2]]]  # tetrahedron 2 is that of corner 2
    sigma = np.linalg.det(edges)
    h = (sigma + np.sqrt(sigma**2 + 4 * delta**2)) / 2
    alone = (edges**2).sum(axis=(1, 2)) / (3 * h ** (2 / 3))
    full, rest = energies(points, hexes, delta), energies(points, hexes, delta, one)
    positive = (full > 0) & (rest > 0)  # below zero, where delta may take it, energy counts as zero
    assert positive.sum() > 20
    np.testing.assert_allclose((full - rest)[positive], ((alone - 1) / 8)[positive], atol=1e-9)


def test_an_inverted_tetrahedron_that_is_left_out_makes_no_energy_infinite():
    mesh = scrambled(grid(5), 1.0)
    sigma = np.linalg.det(
        mesh.points[mesh.hexes[:, CORNER_TETRAHEDRA[:, 1:]]] - mesh.points[mesh.hexes[:, CORNER_TETRAHEDRA[:, :1]]]
    )
    omitted = pack_corners(sigma <= 0)
    assert 0 < np.count_nonzero(omitted) < mesh.n_hexes
    energy = MeshEnergy(mesh, SQUARES, omitted)
    x = energy.to_edge_units(mesh.points)
    assert np.isfinite(energy.value(x))
    assert np.isfinite(energy.gradient(x)).all()
    assert np.isfinite(energy.hessian(x) @ np.ones(3 * energy.nodes.size)).all()
    assert np.isfinite(energy.hessian(x).assembled().off_diagonal).all()


def bad_hexes():
    """Points and hexes of which none has a finite energy at delta = 0, however they went wrong."""
    cube = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1.0]])
    collapsed, no_number, far = cube.copy(), cube.copy(), cube * 1e160
    collapsed[[1, 3, 4]] = collapsed[0]
    no_number[6, 1] = np.nan
    flat = cube * [1, 1, 0]
    mirrored = cube * [1, 1, -1]
    kinds = [collapsed, no_number, far, flat, mirrored, np.zeros((8, 3))]
    return np.concatenate(kinds), np.arange(8 * len(kinds), dtype=np.int32).reshape(-1, 8)


def test_what_has_no_energy_is_never_taken_for_perfect():
    points, hexes = bad_hexes()
    assert (energies(points, hexes) == np.inf).all()
    softened = energies(points, hexes, 0.1)
    assert (softened[[1, 2]] == np.inf).all()
    assert (softened[:5] > 0).all()  # a hex of no extent is better than perfect by the formula


def test_a_node_beside_a_collapsed_corner_is_left_alone():
    mesh = scrambled(grid(4), 0.1)
    points = mesh.points.copy()
    node = int(np.flatnonzero(mesh.free)[0])
    star = mesh.topology.node_corners[node]
    nodes = mesh.hexes[star[0] // 8]
    tetrahedron = next(t for t in CORNER_TETRAHEDRA if nodes[t[0]] != node)
    points[nodes[tetrahedron]] = points[node] + 0.3  # a corner of no extent
    points[node] -= 0.3
    assert local.patch_energy(points, mesh.hexes, star, 0.0, 0.0, SQUARES).value == np.inf
    moved = points.copy()
    settings = local.NodeStepSettings(local.Direction.STEEPEST_DESCENT, 0.0, SQUARES, LineSearch())
    local.sweep(moved, mesh.topology.hex_mesh, np.array([0, 1], np.int32), np.array([node], np.int32), settings)
    np.testing.assert_array_equal(moved, points)


@pytest.mark.parametrize("parts", [1, 3])
def test_large_loops_have_the_same_bits_with_any_number_of_threads(parts):
    mesh = scrambled(grid(20), 0.3)
    energy = MeshEnergy(mesh)
    energy.reduction.ordered_nodes = BlockSparsity(mesh, parts)
    assert energy.sparsity.bounds.size == 2 * parts
    x = energy.to_edge_units(mesh.points)
    colours = mesh.topology.colouring(mesh.free)
    settings = local.NodeStepSettings(local.Direction.NEWTON, 0.1, SQUARES, LineSearch())

    def answer():
        matrix = energy.hessian(x, 0.1).assembled()
        solved = matrix.solve(-energy.gradient(x, 0.1).ravel(), 1e-6, 60)
        swept, places, step = x.copy(), np.empty((mesh.n_hexes, 8, 3)), solved.x.reshape(-1, 3).copy()
        local.sweep(swept, mesh.topology.hex_mesh, colours.start, colours.items, settings)
        element_step.element_steps(x, mesh.hexes, 1.0, 0.5, places)
        step_limits.shorten(step, x, mesh.topology.hex_mesh, energy.nodes, 0.1)
        pattern = BlockSparsity(mesh, parts)
        found = matrix.off_diagonal, matrix.diagonal, solved.x, swept, places, step, pattern.columns
        return [array.tobytes() for array in (*found, matrix @ solved.x, pattern.slots)]

    first, *others = by_threads(answer, (1, 2, 3, 5))
    assert all(other == first for other in others)


# Objects that kernels take view arrays: they keep them alive, and refuse arrays that do not fit.


def arrays(mesh):
    """Copies of the connectivity that nothing else holds."""
    corners = mesh.topology.node_corners
    return mesh.hexes.copy(), corners.start.copy(), corners.items.copy()


def test_an_object_keeps_its_arrays_alive_and_lets_them_go():
    given = arrays(grid(3))
    before = [sys.getrefcount(array) for array in given]
    view = HexMesh(*given)
    assert [sys.getrefcount(array) for array in given] == [count + 1 for count in before]
    del view
    gc.collect()
    assert [sys.getrefcount(array) for array in given] == before


def test_a_sliding_surface_keeps_the_arrays_of_its_parts():
    mesh = scrambled(grid(3), 0.1)
    sliding = SlidingBoundary(mesh)
    expected, moved = mesh.points.copy(), mesh.points.copy()
    ring, nodes, surface = sliding.rings, sliding.nodes.astype(np.int32), sliding.sliding_surface
    laplacian.in_place(expected, ring.start, ring.items, nodes, surface)
    del sliding
    gc.collect()
    laplacian.in_place(moved, ring.start, ring.items, nodes, surface)
    np.testing.assert_array_equal(moved, expected)


def test_a_surface_wants_tangents_and_tangents_a_surface():
    mesh = grid(3)
    sliding, colours = SlidingBoundary(mesh), mesh.topology.colouring(mesh.free)
    settings = local.NodeStepSettings(local.Direction.NEWTON, 0.1, (2.0, 1.0), LineSearch())
    given = mesh.points.copy(), mesh.topology.hex_mesh, colours.start, colours.items, settings
    with pytest.raises(ValueError, match="surface and tangents"):
        local.sweep(*given, sliding.sliding_surface)
    with pytest.raises(ValueError, match="surface and tangents"):
        local.sweep(*given, tangents=sliding.tangents(mesh.points))
    with pytest.raises(ValueError, match=r"^tangents: "):
        local.sweep(*given, sliding.sliding_surface, sliding.tangents(mesh.points)[1:])


def test_a_line_search_passes_on_the_exceptions_of_the_energy():
    def fails(alpha):
        raise ZeroDivisionError("no energy")

    with pytest.raises(ZeroDivisionError, match="no energy"):
        LineSearch()(fails, 1.0, -1.0)


def test_the_rounding_of_a_negative_energy_ends_a_line_search():
    assert LineSearch()(lambda alpha: 0.0, -1.0, -1e-16) == (0.0, 0)


# Averages along dual sheets against plain NumPy.


def averages(values, known, groups):
    """Mean of the means of the known values in the groups around each edge, and True for edges that have one."""
    marks = known[groups]
    number = marks.sum(axis=1)
    some = number > 0
    groups, number = groups[some], number[some]
    means = (values[groups] * marks[some]).sum(axis=1) / number
    total = np.bincount(groups.ravel(), np.repeat(means, 4), minlength=len(values))
    count = np.bincount(groups.ravel(), minlength=len(values))
    return total / np.maximum(count, 1), count


def filled(values, known, groups):
    """Values of unknown edges, front by front over all groups."""
    values, known = values.copy(), known.copy()
    while True:
        average, count = averages(values, known, groups)
        front = (count > 0) & ~known
        front[-1] = False
        if not front.any():
            return values, known
        values[front] = average[front]
        known |= front


def mesh_groups(size, seed):
    """Groups of the parallel edges of a mesh, values of its edges, and some that are known."""
    mesh = make("five-side", size=size)
    rng = np.random.default_rng(seed)
    groups, count = edge_numbers(mesh.topology).reshape(-1, 4).copy(), len(mesh.topology.edges)
    groups[rng.random(groups.shape) < 0.02] = count
    known = np.append(rng.random(count) < rng.choice([0.01, 0.3]), False)
    return mesh, groups, np.append(rng.uniform(-1, 1, count), 7.0), known


@given(st.integers(8, 200), st.integers(0, 10**6))
def test_averages_are_those_of_numpy(size, seed):
    _, groups, values, _ = mesh_groups(size, seed)
    average, count = np.empty(len(values)), np.empty(len(values), dtype=np.int32)
    structure.average_along_sheets(groups, values, average, count)
    expected, number = averages(values, np.arange(len(values)) < len(values) - 1, groups)
    np.testing.assert_allclose(average[:-1], expected[:-1], rtol=1e-14, atol=1e-15)
    np.testing.assert_array_equal(count[:-1], number[:-1])
    assert (average[-1], count[-1]) == (0, 0)


@given(st.integers(8, 200), st.integers(0, 10**6))
def test_fronts_are_those_of_numpy(size, seed):
    mesh, groups, values, known = mesh_groups(size, seed)
    values[-1] = 0
    expected, reached = filled(values, known, groups)
    Sheets(mesh, np.arange(mesh.n_hexes)).fill(values, known, groups)
    np.testing.assert_array_equal(known, reached)
    np.testing.assert_allclose(values, expected, rtol=1e-12, atol=1e-14)


def test_groups_that_name_no_edge_are_refused():
    values = np.zeros(3)
    for wrong in (-1, 3):
        groups = np.array([[0, 1, 1, wrong]], dtype=np.int32)
        with pytest.raises(ValueError, match="numbers of edges"):
            structure.average_along_sheets(groups, values, np.zeros(3), np.zeros(3, dtype=np.int32))
