"""The energy of boundary quads in their tangent planes, and of a sliding mesh with it, against differences."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend.boundary import SlidingBoundary
from hexmend.energy import ObjectiveNorm
from hexmend.energy.quads import SurfaceQuads
from hexmend.energy.quads.quad_energy import QuadCorners
from tests.core.boundary.solids import slid
from tests.core.energy.projected import projected_energy
from tests.core.energy.test_linear_motion_energy import SOLIDS, along_the_surface
from tests.core.grids import grid

SQUARE = np.array([[[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]], dtype=float)
UP = np.array([[0.0, 0.0, 1.0]])
seeds = st.integers(0, 2**32 - 1)


def corners_of(x, delta=0.0, normals=UP, counted=None, scales=None):
    every = np.ones(x.shape[:2], dtype=bool)
    scales = np.ones((2, *x.shape[:2])) if scales is None else scales
    return QuadCorners.of(x, normals, scales, every if counted is None else counted, delta)


@given(seeds, st.floats(-20, 20))
def test_a_square_of_any_size_has_no_energy(seed, exponent):
    x = SQUARE * 2.0**exponent + np.random.default_rng(seed).normal(size=3)
    np.testing.assert_allclose(corners_of(x).energies(1.0), 0, atol=1e-6)
    np.testing.assert_allclose(corners_of(x).qualities, 1, atol=1e-6)
    np.testing.assert_allclose(corners_of(x).scaled_jacobians, 1, atol=1e-6)


def test_a_rectangle_has_the_energy_of_its_aspect_and_none_with_its_lengths():
    x = SQUARE * [2.0, 1.0, 1.0]
    assert corners_of(x).energies(0.0)[0] == pytest.approx((4 + 1) / (2 * 2))
    along = np.array([[2.0, 1.0, 2.0, 1.0]])  # from corner to next corner
    scales = 1 / np.stack([along, np.roll(along, 1, axis=1)])
    assert corners_of(x, scales=scales).energies(0.0)[0] == pytest.approx(1)


def test_the_side_is_told_by_the_normal():
    assert corners_of(SQUARE, normals=-UP).energies(1.0)[0] == np.inf
    assert (corners_of(SQUARE, normals=-UP).sigma == -1).all()
    softened = [corners_of(SQUARE, 0.1, normal).energies(1.0)[0] for normal in (UP, -UP)]
    assert softened[0] < 0.1 < 10 < softened[1] < np.inf


@given(seeds, st.sampled_from([0.0, 0.02, 0.5]))
def test_first_and_second_derivatives_are_those_of_differences(seed, delta):
    random = np.random.default_rng(seed)
    x = SQUARE + random.uniform(-0.5, 0.5, SQUARE.shape)
    normals = random.normal(size=(1, 3)) * 0.3 + UP
    normals /= np.linalg.norm(normals)
    counted, scales = random.random((1, 4)) < 0.8, random.uniform(0.5, 2, (2, 1, 4))
    if delta == 0:  # flipped corners have no derivatives
        counted &= corners_of(x, 0.0, normals, counted, scales).sigma > 0.05
    at = corners_of(x, delta, normals, counted, scales)
    v, t = random.normal(size=x.shape), 1e-6
    ahead, back = (corners_of(x + sign * t * v, delta, normals, counted, scales) for sign in (1, -1))
    gradient, hessian = at.gradients(), at.hessians()
    rise = (ahead.energies(1.0) - back.energies(1.0))[0] / (2 * t)
    assert rise == pytest.approx((gradient * v).sum(), rel=1e-5, abs=1e-5 * (1 + np.abs(gradient).sum()))
    product = np.einsum("fabij,fbj->fai", hessian, v)
    rise = (ahead.gradients() - back.gradients()) / (2 * t)
    np.testing.assert_allclose(rise, product, rtol=1e-4, atol=1e-5 * (1 + np.abs(product).max()))
    np.testing.assert_allclose(hessian, hessian.transpose(0, 2, 1, 4, 3), atol=1e-9 * (1 + np.abs(hessian).max()))


def with_quads(solid, seed, p, offset=1.0):
    """Return the energy of a solid with moved nodes and its quads, their positions, and a tangential step."""
    there, norm = slid(SOLIDS[solid](), 0.2, seed), ObjectiveNorm(p, offset)
    sliding = SlidingBoundary(SOLIDS[solid]())
    energy = projected_energy(sliding, norm)
    term = SurfaceQuads(sliding, norm, 3.0).at(there.points, 0.05, 0.05)
    x = energy.to_edge_units(there.points)
    return energy.with_surface(term), x, along_the_surface(sliding, there.points, seed)


cases = given(st.sampled_from(sorted(SOLIDS)), seeds, st.sampled_from([1.0, 2.0, 3.5]))


@cases
def test_gradient_and_hessian_of_the_mesh_are_those_of_differences(solid, seed, p):
    energy, x, step = with_quads(solid, seed, p)
    t, delta = 1e-6, 0.05
    ahead, back = energy.moved(x, step, t), energy.moved(x, step, -t)
    gradient = energy.gradient(x, delta)
    rise = (energy.value(ahead, delta) - energy.value(back, delta)) / (2 * t)
    assert rise == pytest.approx((gradient * step).sum(), rel=1e-5, abs=1e-5 * np.abs(gradient).sum())
    product = energy.hessian(x, delta).matvec(step.ravel()).reshape(-1, 3)
    rise = (energy.gradient(ahead, delta) - energy.gradient(back, delta)) / (2 * t)
    np.testing.assert_allclose(rise, product, rtol=1e-4, atol=1e-5 * np.abs(product).max())


def test_corners_between_curves_and_between_fixed_nodes_count_as_perfect():
    sliding = SlidingBoundary(grid(2))
    term = SurfaceQuads(sliding, ObjectiveNorm(), 1.0).at(sliding.mesh.points, 0.0, 0.01)
    assert (term.counted.sum(axis=1) == 3).all()  # one corner of each quad lies between two edges of the cube
    pinned = SlidingBoundary(grid(2).replace(pinned=np.arange(27) > 0))
    quads = SurfaceQuads(pinned, ObjectiveNorm(), 1.0)
    assert not quads.at(pinned.mesh.points, 0.0, 0.01).counted.any()


def test_quads_are_softened_while_one_is_flipped_or_hexes_are():
    block = grid(3)
    sliding, softening = SlidingBoundary(block), 0.02
    quads = SurfaceQuads(sliding, ObjectiveNorm(), 1.0)
    assert quads.at(block.points, 0.0, softening).delta == 0
    assert quads.at(block.points, 0.3, softening).delta == 0.3
    points = block.points.copy()
    node = sliding.nodes[sliding.node_class[sliding.nodes] == 3][0]
    points[node] += 1.5 * sliding.tangent_bases(points[[node]], np.array([node]))[0, :, 0]
    assert quads.at(points, 0.0, softening).delta == 0.02
    assert quads.objective(points).value is None
    assert quads.objective(np.full_like(points, np.nan)).value is None
