"""Kernels on wedges, pyramids and tetrahedra: rows of eight nodes whose last node is repeated."""

import numpy as np
import pytest
from hexmend import kernels
from numpy.testing import assert_allclose

ROOT3 = 3**0.5
_TETRAHEDRON = np.array([[1, 0, 0], [0.5, ROOT3 / 2, 0], [0.5, ROOT3 / 6, (2 / 3) ** 0.5]]).T
_WEDGE = np.array([[1, 0, 0], [0.5, ROOT3 / 2, 0], [0, 0, 1]]).T
_PYRAMID = np.array([[1, 0, 0], [0, 1, 0], [0.5, 0.5, 0.5**0.5]]).T
_HEX_CORNERS = [(0, 3, 4, 1), (1, 0, 5, 2), (2, 1, 6, 3), (3, 2, 7, 0), (4, 7, 5, 0), (5, 4, 6, 1), (6, 5, 7, 2), (7, 6, 4, 3)]

#: Of each kind: nodes of the ideal cell, its corner tetrahedra, the edges of an ideal one as columns.
KINDS = {
    "hexahedron": (
        np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]], float),
        _HEX_CORNERS,
        np.eye(3),
    ),
    "wedge": (
        np.array([[0, 0, 0], _WEDGE[:, 0], _WEDGE[:, 1], [0, 0, 1], _WEDGE[:, 0] + [0, 0, 1], _WEDGE[:, 1] + [0, 0, 1]]),
        [(0, 1, 2, 3), (1, 2, 0, 4), (2, 0, 1, 5), (3, 5, 4, 0), (4, 3, 5, 1), (5, 4, 3, 2)],
        _WEDGE,
    ),
    "pyramid": (
        np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, 0.5, 0.5**0.5]]),
        [(0, 1, 3, 4), (1, 2, 0, 4), (2, 3, 1, 4), (3, 0, 2, 4)],
        _PYRAMID,
    ),
    "tetrahedron": (np.concatenate([[[0, 0, 0]], _TETRAHEDRON.T]), [(0, 1, 2, 3)], _TETRAHEDRON),
}


def row_of(nodes):
    """Row of eight nodes of a cell."""
    return [*nodes, *[nodes[-1]] * (8 - len(nodes))]


def mixed(seed=0, spread=0.15, copies=3):
    """Cells of all kinds that share nodes at random: points and rows; corners and W of each row."""
    rng = np.random.default_rng(seed)
    points, rows, about = [], [], []
    for name, (ideal, corners, w) in KINDS.items():
        for _ in range(copies):
            rows.append(row_of(range(len(points), len(points) + len(ideal))))
            points.extend(ideal + rng.uniform(-spread, spread, ideal.shape))
            about.append((name, corners, w))
    return np.array(points), np.array(rows, np.int32), about


def shapes(points, row, about):
    """S W^-1 at each corner tetrahedron of a cell."""
    _, corners, w = about
    x = points[row]
    return np.array([np.column_stack([x[k] - x[a] for k in ends]) @ np.linalg.inv(w) for a, *ends in corners])


def eta(shape, delta=0.0):
    sigma = np.linalg.det(shape)
    h = 0.5 * (sigma + np.sqrt(sigma**2 + 4 * delta**2)) if delta else np.maximum(sigma, 0)
    with np.errstate(divide="ignore"):
        return (shape**2).sum(axis=(1, 2)) / (3 * h ** (2 / 3))


def energies(points, rows, about, delta=0.0):
    return np.array([eta(shapes(points, row, of), delta).mean() - 1 for row, of in zip(rows, about, strict=True)])


def gradient(points, rows, delta, norm):
    shares = np.empty((len(rows), 8, 3))
    kernels.objective.gradient(points, rows, delta, norm, np.zeros(len(rows), np.uint8), shares)
    total = np.zeros_like(points)
    np.add.at(total, rows, shares)
    return total


def test_the_ideal_cells_are_perfect_and_their_figures_are_those_of_the_formulas():
    points, rows, about = mixed(spread=0)
    q, sigma, jacobian, energy = (np.empty(len(rows)) for _ in range(4))
    kernels.elements.measure(points, rows, q, sigma, jacobian, energy)
    for values in (q, sigma, jacobian):
        assert_allclose(values, 1, atol=1e-14)
    points, rows, about = mixed(seed=1)
    kernels.elements.measure(points, rows, q, sigma, jacobian, energy)
    for i, (row, of) in enumerate(zip(rows, about, strict=True)):
        shape = shapes(points, row, of)
        edges = shape @ of[2]
        assert_allclose(q[i], (1 / eta(shape)).mean(), rtol=1e-12)
        assert_allclose(sigma[i], np.linalg.det(shape).min(), rtol=1e-12)
        scaled = np.linalg.det(edges) / np.linalg.norm(edges, axis=1).prod(axis=1) / np.linalg.det(of[2])
        assert_allclose(jacobian[i], scaled.min(), rtol=1e-12)
        assert_allclose(energy[i], eta(shape).mean() - 1, atol=1e-13)


@pytest.mark.parametrize("delta", [0.0, 0.3])
def test_energies_and_their_derivatives(delta):
    points, rows, about = mixed(seed=2)
    found = np.empty(len(rows))
    kernels.objective.energies(points, rows, delta, 1.0, np.zeros(len(rows), np.uint8), found)
    assert_allclose(found, np.maximum(energies(points, rows, about, delta), 0), atol=1e-13)
    rng = np.random.default_rng(3)
    direction = rng.standard_normal(points.shape)
    step = 1e-6
    for norm in ((1.0, 0.0), (2.0, 0.0)):  # with an offset of 1 the power is cut off at 0

        def value(at, p=norm[0]):
            return ((energies(at, rows, about, delta) + 1) ** p).sum()

        slope = (value(points + step * direction) - value(points - step * direction)) / (2 * step)
        assert_allclose((gradient(points, rows, delta, norm) * direction).sum(), slope, rtol=1e-7)
        shares = np.empty((len(rows), 8, 3))
        kernels.objective.hessian_product(
            points, rows, rows, direction, delta, norm, np.zeros(len(rows), np.uint8), shares
        )
        product = np.zeros_like(points)
        np.add.at(product, rows, shares)
        ahead, behind = (gradient(points + s * step * direction, rows, delta, norm) for s in (1, -1))
        assert_allclose(product, (ahead - behind) / (2 * step), atol=2e-6 * np.abs(product).max())
