"""Gradient and Hessian of the energy, element by element against complex steps and for whole meshes against differences.

Inverted and degenerate elements are among the cases; delta = 0 is tried where no element is inverted.
"""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from hexmend.energy import MeshEnergy, ObjectiveNorm
from hexmend.kernels import objective
from hexmend.mesh.hexahedron import CORNER_TETRAHEDRA, UNIT_CUBE
from hexmend.quality import measure
from tests.core.grids import grid, scrambled

seeds = st.integers(0, 2**32 - 1)
powers = st.builds(ObjectiveNorm, st.sampled_from([1.0, 1.5, 2.0, 3.5]), st.sampled_from([1.0, 0.4, 0.0]))


def eta_of(x, delta, offset=1.0):
    """eta(H) before it is clamped, as the book writes it; x may be complex."""
    edges = np.stack([x[CORNER_TETRAHEDRA[:, k]] - x[CORNER_TETRAHEDRA[:, 0]] for k in (1, 2, 3)], axis=2)
    sigma = np.linalg.det(edges)
    h = (sigma + np.sqrt(sigma * sigma + 4 * delta * delta)) / 2  # (3.2)
    return ((edges * edges).sum(axis=(1, 2)) / (3 * h ** (2 / 3))).mean() - offset  # (3.1), (B.20)


HEX, WHOLE = np.arange(8, dtype=np.int32)[None], np.zeros(1, np.uint8)


def energy_of(x, delta, offset=1.0):
    """eta(H) by the kernel: what falls below zero counts as zero."""
    eta = np.empty(1)
    objective.energies(x, HEX, delta, offset, WHOLE, eta)
    return eta[0]


ETA = ObjectiveNorm(1.0)


def gradient_of(x, delta, norm=ETA):
    """The gradient of eta(H)^p by the kernel, (8, 3)."""
    shares = np.empty((1, 8, 3))
    objective.gradient(x, HEX, delta, norm, WHOLE, shares)
    return shares[0]


def product_of(x, v, delta, norm):
    """The Hessian of eta(H)^p times v by the kernel, (8, 3)."""
    shares = np.empty((1, 8, 3))
    objective.hessian_product(x, HEX, HEX, v, delta, norm, WHOLE, shares)
    return shares[0]


def complex_gradient(x, delta):
    gradient = np.empty((8, 3))
    for place in np.ndindex(8, 3):
        there = x.astype(complex)
        there[place] += 1e-40j
        gradient[place] = eta_of(there, delta).imag / 1e-40
    return gradient


@st.composite
def corners(draw):
    """Corners of a hex with a delta: sound, softened, turned inside out, or with corners that coincide."""
    random = np.random.default_rng(draw(seeds))
    kind = draw(st.sampled_from(["sound", "soft", "tangled", "mirrored", "degenerate"]))
    amplitude = {"sound": 0.3, "soft": 0.3, "tangled": 1.6, "mirrored": 0.3, "degenerate": 0.3}[kind]
    x = UNIT_CUBE + amplitude * random.uniform(-0.5, 0.5, (8, 3))
    if kind == "mirrored":
        x[:, 0] *= -1
    if kind == "degenerate":
        x[1] = x[0]  # sigma = 0 at two corners, an edge of no length
        x[6] = x[2] + x[5] - x[1]  # and a flat one
    delta = 0.0 if kind == "sound" else draw(st.sampled_from([0.02, 0.1, 0.5]))
    if kind == "sound":
        assume(np.linalg.det(x[CORNER_TETRAHEDRA[:, 1:]] - x[CORNER_TETRAHEDRA[:, :1]]).min() > 0.02)
    return x, delta


@given(corners(), st.sampled_from([1.0, 0.0]))
def test_gradient_of_a_hex_is_that_of_complex_steps(case, offset):
    x, delta = case
    expected = complex_gradient(x, delta)
    assume(eta_of(x, delta, offset) > 1e-9)  # softened by delta it may be below zero, where it counts as zero
    assert energy_of(x, delta, offset) == pytest.approx(eta_of(x, delta, offset), rel=1e-10)
    np.testing.assert_allclose(
        gradient_of(x, delta, ObjectiveNorm(1.0, offset)), expected, rtol=1e-9, atol=1e-9 * np.abs(expected).max()
    )


@given(corners(), seeds, powers)
def test_hessian_of_a_hex_is_that_of_differences_of_complex_gradients(case, seed, norm):
    (x, delta), (p, offset) = case, norm
    assume(eta_of(x, delta, offset) > 1e-2)
    v = np.random.default_rng(seed).normal(size=(8, 3))

    def of_power(y):
        return p * eta_of(y, delta, offset) ** (p - 1) * complex_gradient(y, delta)

    step = 1e-4 * max(delta, 0.02) / np.abs(v).max()
    coarse, fine = ((of_power(x + h * v) - of_power(x - h * v)) / (2 * h) for h in (2 * step, step))
    expected = (4 * fine - coarse) / 3  # Richardson: fourth order
    product = product_of(x, v, delta, norm)
    np.testing.assert_allclose(product, expected, rtol=1e-5, atol=1e-6 * np.abs(expected).max())


@given(seeds, st.sampled_from([1.0, 1.5, 2.0, 3.5]))
def test_what_softened_energy_falls_below_zero_counts_as_zero(seed, p):
    x = UNIT_CUBE + 0.01 * np.random.default_rng(seed).uniform(-1, 1, (8, 3))
    assert eta_of(x, 0.5) < 0
    assert energy_of(x, 0.5) == 0
    assert (gradient_of(x, 0.5, ObjectiveNorm(p)) == 0).all()
    assert (product_of(x, np.ones((8, 3)), 0.5, ObjectiveNorm(p)) == 0).all()


def check_mesh(energy, delta, seed, rtol=1e-5):
    """Compare the derivatives of a mesh's energy with differences; returns a direction, the Hessian, and its product."""
    x, v = energy.to_edge_units(energy.mesh.points), np.random.default_rng(seed + 1).normal(size=(energy.nodes.size, 3))
    gradient, hessian, step = energy.gradient(x, delta), energy.hessian(x, delta), 1e-6

    def difference(of):
        return (of(energy.moved(x, step * v), delta) - of(energy.moved(x, -step * v), delta)) / (2 * step)

    assert np.vdot(gradient, v) == pytest.approx(difference(energy.value), rel=rtol, abs=1e-6)
    expected, product = difference(energy.gradient).ravel(), hessian @ v.ravel()
    np.testing.assert_allclose(product, expected, rtol=10 * rtol, atol=rtol * np.abs(expected).max())
    return v.ravel(), hessian, product


@given(seeds, powers, st.sampled_from([0.0, 0.05]))
def test_derivatives_of_a_mesh_are_those_of_differences(seed, norm, delta):
    mesh = scrambled(grid(3), 0.2 if delta == 0 else 0.8, seed)
    assume(delta > 0 or measure(mesh.points, mesh.hexes).q.min() > 0.2)
    check_mesh(MeshEnergy(mesh, norm), delta, seed)
