"""Derivatives of the energy under linear constraints, against differences."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend.arrays import mask
from hexmend.boundary import SlidingBoundary
from hexmend.energy import MeshEnergy, ObjectiveNorm
from hexmend.mesh.element_target import Target
from hexmend.mesh.linear_motion import LinearMotion
from hexmend.optimise.floors.movable_hexes import Region
from tests.core.boundary.solids import cylinder
from tests.core.energy.projected import projected_energy
from tests.core.grids import grid, scrambled
from tests.core.linear_motions import face, planes, turn

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
    "several": LinearMotion.tying(X1, X0).merge(LinearMotion.tying(face(BLOCK, 1, 2), face(BLOCK, 1, 0))),
}
cases = given(st.sampled_from(sorted(MOTIONS)), st.integers(0, 2**32 - 1), st.sampled_from([1.0, 2.0, 3.5]))


def at(name, seed, p):
    """Return the energy of the block with a linear motion, its points in mean edge lengths, and an admissible step."""
    mesh = BLOCK.with_linear_motion(MOTIONS[name])
    energy = MeshEnergy(mesh, ObjectiveNorm(p))
    step = np.random.default_rng(seed).uniform(-1, 1, (energy.nodes.size, 3))
    x = energy.to_edge_units(mesh.points)
    return energy, x, step - energy.motion.inadmissible(x, step)


@cases
def test_gradient_is_that_of_differences(name, seed, p):
    energy, x, step = at(name, seed, p)
    t, delta = 1e-6, 0.05
    rise = energy.value(energy.moved(x, step, t), delta) - energy.value(energy.moved(x, step, -t), delta)
    gradient = energy.gradient(x, delta)
    assert rise / (2 * t) == pytest.approx((gradient * step).sum(), rel=1e-5, abs=1e-5 * np.abs(gradient).sum())
    assert np.abs(energy.motion.inadmissible(x, gradient)).max() <= 1e-12 * np.abs(gradient).max()


@cases
def test_hessian_is_that_of_differences(name, seed, p):
    energy, x, step = at(name, seed, p)
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
