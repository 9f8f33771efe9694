"""Derivatives of the energy under linear constraints and along a surface, against differences."""

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hexmend.arrays import mask
from hexmend.boundary import NodeClass, SlidingBoundary
from hexmend.energy import MeshEnergy, Motion, ObjectiveNorm
from hexmend.energy.barriers.floor_barrier import FloorBarrier
from hexmend.mesh.element_target import Target
from hexmend.mesh.linear_motion import LinearMotion
from hexmend.optimise.floors.region import Region
from tests.core.boundary.solids import ball, cylinder, slid
from tests.core.energy.projected import projected_energy
from tests.core.grids import grid, scrambled
from tests.core.linear_motions import face, planes, turn

SOLIDS = {"block": lambda: grid(3, 2, 2), "cylinder": lambda: cylinder(16, 3), "ball": lambda: ball(3)}


def along_the_surface(sliding, points, seed):
    """Make a tangential unit step for each free node; 0 for nodes next to an edge of a facet."""
    mesh, random = sliding.mesh, np.random.default_rng(seed)
    step = random.uniform(-1, 1, mesh.points.shape) * mesh.free[:, None]
    nodes = sliding.nodes
    weights = sliding.surface.trees.closest(points[nodes], sliding.surface.group_of(nodes)).weights
    weights[sliding.boundary.node_class[nodes] == NodeClass.CURVE, 2] = 1
    bases = sliding.tangent_bases(points[nodes])
    step[nodes] = np.einsum("kij,klj,kl->ki", bases, bases, step[nodes])
    step[nodes[weights.min(axis=1) < 0.01]] = 0
    return step[mesh.free]


def on_solid(solid, seed, p):
    """Return the energy of a solid with moved nodes, their positions in mean edge lengths, and a tangential step."""
    there = slid(SOLIDS[solid](), 0.2, seed)
    sliding = SlidingBoundary(SOLIDS[solid]())
    energy = projected_energy(sliding, ObjectiveNorm(p))
    return energy, energy.to_edge_units(there.points), along_the_surface(sliding, there.points, seed)


solid_cases = given(st.sampled_from(sorted(SOLIDS)), st.integers(0, 2**32 - 1), st.sampled_from([1.0, 2.0, 3.5]))


BLOCK = scrambled(grid(3, 2, 2), 0.2)
X0, X1 = face(BLOCK, 0, 0), face(BLOCK, 0, 3)
INNER = np.flatnonzero(~BLOCK.topology.boundary)
PLANES = planes(BLOCK)
MOTIONS = {
    "planes": PLANES,
    "axes and skew planes": PLANES.merge(LinearMotion.in_planes(INNER, [0.3, 1.0, 0])),
    "skew plane inside": LinearMotion.in_planes(INNER[:1], [1.0, 2, 3]).merge(
        LinearMotion.along_lines(X1, [1.0, 1, 0])
    ),
    "translation": LinearMotion.tying(X1, X0),
    "rotation": LinearMotion.tying(X1, X0, turn(25)),
    "within hexes": LinearMotion.tying(BLOCK.hexes[0][1:4], BLOCK.hexes[0][[0, 0, 0]], turn(70, 1)),
    "rotation and planes": LinearMotion.tying(X1, X0, turn(90)).merge(LinearMotion.in_planes(X0, [0.2, 1.0, 0])),
    "hanging": PLANES.merge(LinearMotion.between([[INNER[0], *BLOCK.hexes[0][:4]], [X0[4], *INNER, X1[4], INNER[0]]])),
    "hanging and tied": LinearMotion.tying(X1, X0, turn(25)).merge(
        LinearMotion.between([[INNER[0], X1[4], X1[4], X0[3], INNER[1]]])
    ),
    "several": LinearMotion.tying(X1, X0).merge(LinearMotion.tying(face(BLOCK, 1, 2), face(BLOCK, 1, 0))),
}
cases = given(st.sampled_from(sorted(MOTIONS)), st.integers(0, 2**32 - 1), st.sampled_from([1.0, 2.0, 3.5]))
every_case = given(st.sampled_from([*MOTIONS, *SOLIDS]), st.integers(0, 2**32 - 1), st.sampled_from([1.0, 2.0, 3.5]))


def at(name, seed, p):
    """Return the energy of the block with a linear motion, its points in mean edge lengths, and an admissible step."""
    mesh = BLOCK.with_linear_motion(MOTIONS[name])
    energy = MeshEnergy(mesh, ObjectiveNorm(p))
    step = np.random.default_rng(seed).uniform(-1, 1, (energy.nodes.size, 3))
    x = energy.to_edge_units(mesh.points)
    return energy, x, step - energy.motion.inadmissible(x, step)


@every_case
def test_gradient_is_that_of_differences(name, seed, p):
    energy, x, step = at(name, seed, p) if name in MOTIONS else on_solid(name, seed, p)
    t, delta = 1e-6, 0.05
    rise = energy.value(energy.moved(x, step, t), delta) - energy.value(energy.moved(x, step, -t), delta)
    gradient = energy.gradient(x, delta)
    assert rise / (2 * t) == pytest.approx((gradient * step).sum(), rel=1e-5, abs=1e-5 * np.abs(gradient).sum())
    assert name in SOLIDS or np.abs(energy.motion.inadmissible(x, gradient)).max() <= 1e-12 * np.abs(gradient).max()


@every_case
def test_hessian_is_that_of_differences(name, seed, p):
    energy, x, step = at(name, seed, p) if name in MOTIONS else on_solid(name, seed, p)
    t, delta = 1e-6, 0.05
    rise = energy.gradient(energy.moved(x, step, t), delta) - energy.gradient(energy.moved(x, step, -t), delta)
    product = energy.hessian(x, delta).matvec(step.ravel()).reshape(-1, 3)
    np.testing.assert_allclose(rise / (2 * t), product, rtol=1e-4, atol=1e-5 * np.abs(product).max())


@cases
def test_the_assembled_hessian_has_the_same_products(name, seed, p):
    energy, x, step = at(name, seed, p)
    hessian = energy.hessian(x, 0.05).shifted(0.3)
    product = hessian.matvec(step.ravel())
    matrix = hessian.assembled(np.float64)
    for _ in range(2):  # then in the storage of the first
        np.testing.assert_allclose(matrix @ step.ravel(), product, rtol=1e-8, atol=1e-8 * np.abs(product).max())
        assert np.linalg.matrix_rank(matrix.matrix().toarray()) == matrix.shape[0]
        single = hessian.assembled(np.float32)
        np.testing.assert_allclose(single @ step.ravel(), product, atol=1e-4 * np.abs(product).max())
        matrix = hessian.assembled(np.float64, matrix)


def test_nodes_on_flat_parts_of_a_sliding_boundary_move_linearly_and_others_are_projected():
    sliding = SlidingBoundary(BLOCK)
    energy = MeshEnergy.on_surface(sliding)
    assert not energy.motion.projected.size
    np.testing.assert_array_equal(energy.nodes, np.flatnonzero(sliding.mesh.free))
    sliding = SlidingBoundary(cylinder(16, 3))
    mixed = MeshEnergy.on_surface(sliding)
    assert mixed.mesh.linear_motion is not None
    assert 0 < mixed.motion.projected.size < sliding.nodes.size
    x, whole = mixed.to_edge_units(sliding.mesh.points), projected_energy(sliding)
    gradient = whole.gradient(x)
    np.testing.assert_allclose(mixed.gradient(x), gradient, atol=1e-9 * np.abs(gradient).max())
    np.testing.assert_array_equal(mixed.nodes, whole.nodes)


def test_a_part_none_of_whose_nodes_moves_in_a_plane_has_the_energy_of_its_hexes():
    """The middle of a long cylinder, whose ends alone move, in their planes."""
    mesh = cylinder(16, 9)
    mesh = mesh.with_linear_motion(
        LinearMotion.in_planes(np.concatenate([face(mesh, 2, 0), face(mesh, 2, 1)]), [0, 0, 1.0])
    )
    energy = MeshEnergy(mesh)
    assert energy.motion.has_parts
    middle = np.flatnonzero(np.abs(mesh.points[mesh.hexes].mean(axis=1)[:, 2] - 0.5) < 0.05)
    x = energy.to_edge_units(mesh.points)
    region = Region(energy, mask(mesh.hexes[middle], mesh.n_nodes), x)
    assert region.energy.mesh.linear_motion is None
    assert region.energy.value(region.inside(x)) == pytest.approx(np.square(energy.hex_energies(x)[region.hexes]).sum())
    step = np.random.default_rng(1).uniform(-0.1, 0.1, (region.energy.nodes.size, 3))
    merged = region.merged(x, region.energy.moved(region.inside(x), step))
    assert set(np.flatnonzero((merged != x).any(axis=1))) <= set(mesh.hexes[region.hexes].ravel())


def test_the_gradient_without_size_is_that_of_the_shape_alone():
    """The size went on counting in gradients of meshes with a linear motion."""
    lengths = np.random.default_rng(2).uniform(0.5, 1.5, (BLOCK.n_hexes, 3))
    mesh = BLOCK.with_linear_motion(PLANES).with_element_target(Target(lengths, 1.0))
    energy = MeshEnergy(mesh).without_size()
    x, step, t = energy.to_edge_units(mesh.points), np.random.default_rng(3).normal(size=(energy.nodes.size, 3)), 1e-6
    rise = energy.value(energy.moved(x, step, t), 0.05) - energy.value(energy.moved(x, step, -t), 0.05)
    assert rise / (2 * t) == pytest.approx((energy.gradient(x, 0.05) * step).sum(), rel=1e-5)


@solid_cases
def test_the_assembled_hessian_has_the_same_products_along_the_surface(solid, seed, p):
    energy, x, step = on_solid(solid, seed, p)
    hessian = energy.hessian(x, 0.05).shifted(0.3)
    product = hessian.matvec(step.ravel())
    np.testing.assert_allclose(
        hessian.assembled(np.float64) @ step.ravel(), product, rtol=1e-8, atol=1e-8 * np.abs(product).max()
    )


@settings(max_examples=5)
@solid_cases
def test_off_the_surface_nothing_is_coupled_and_no_eigenvalue_is_an_extreme(solid, seed, p):
    energy, x, _ = on_solid(solid, seed, p)
    matrix = energy.hessian(x, 0.05).assembled(np.float64)
    whole = np.stack([matrix @ one for one in np.eye(matrix.shape[0])])
    rows = np.searchsorted(energy.nodes, energy.motion.projected)
    projector = np.eye(len(whole))
    for row, along in zip(rows, energy.motion.turn(x), strict=True):
        projector[3 * row : 3 * row + 3, 3 * row : 3 * row + 3] = along
    off = np.eye(len(whole)) - projector
    np.testing.assert_allclose(off @ whole @ projector, 0, atol=1e-9 * np.abs(whole).max())
    along = np.linalg.eigvalsh(projector @ whole @ projector)
    beside = np.linalg.eigvalsh(off @ whole @ off)
    assert beside.max() <= along.max() * (1 + 1e-9)


def test_values_that_are_kept_are_those_of_another_energy_only_where_it_is_the_same():
    energy, x, _ = on_solid("cylinder", 5, 2.0)
    floors = np.full(energy.mesh.n_hexes, -1.5)
    barriers = [None, *(FloorBarrier(floors, floors, energy.omitted, 4.0, 4.0, weight) for weight in (1.0, 2.0))]
    omitted = np.zeros(energy.mesh.n_hexes, np.uint8)
    omitted[0] = 1
    cases = [
        energy.with_objective(ObjectiveNorm(p, offset), of).with_barrier(barrier)
        for p, offset, of, barrier in itertools.product([1.0, 2.0], [1.0, 0.5], [energy.omitted, omitted], barriers)
    ]
    values = []
    for case, delta in itertools.product(cases, [0.05, 0.1]):
        fresh = on_solid("cylinder", 5, 2.0)[0].with_objective(case.norm, case.omitted).with_barrier(case.barrier)
        each = case.with_barriers(x, delta).copy()
        for of in (case, energy.with_objective(case.norm, case.omitted).with_barrier(case.barrier)):
            values.append(of.value(x, delta))
            assert values[-1] == fresh.value(x.copy(), delta) == of.value(x, delta)
            np.testing.assert_array_equal(of.with_barriers(x, delta), each)
    assert len(set(values)) == len(values) // 2


def test_a_rank_whose_neighbours_alone_own_sliding_nodes_moves_its_own_in_space():
    sliding = SlidingBoundary(cylinder(16, 3))
    mesh, slides = sliding.mesh, mask(sliding.nodes, sliding.mesh.n_nodes)
    energy = MeshEnergy(mesh, motion=Motion(mesh, sliding, sliding.nodes, owned=~slides))
    whole, x = MeshEnergy(mesh), energy.to_edge_units(mesh.points)
    gradient, own = energy.gradient(x, 0.1), ~slides[whole.nodes]
    np.testing.assert_array_equal(gradient, whole.gradient(x, 0.1)[own])
    np.testing.assert_array_equal(energy.moved(x, gradient)[slides], x[slides])
    assert energy.directional_derivative(x, 0.1, -gradient, gradient) == pytest.approx(-(gradient**2).sum())
    diagonal = energy.hessian(x, 0.1).assembled(np.float64).diagonal_blocks
    of_all = whole.hessian(x, 0.1).assembled(np.float64).diagonal_blocks
    np.testing.assert_allclose(diagonal, of_all[own], rtol=1e-12, atol=1e-12 * np.abs(of_all).max())
