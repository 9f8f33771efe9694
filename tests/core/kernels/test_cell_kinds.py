"""Kernels on wedges, pyramids and tetrahedra: rows of eight nodes whose last node is repeated."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hexmend import kernels
from hexmend.mesh.solid_cells import SOLID_KINDS
from tests.core.solid_lattices import single


def ideal_nodes(kind):
    """Places of the nodes of an ideal cell."""
    mesh = single(kind)
    return mesh.points[mesh.elements[0, : kind.nodes]]


#: Of each kind: nodes of the ideal cell, its corner tetrahedra, the edges of an ideal one as columns.
KINDS = {kind.name: (ideal_nodes(kind), kind.corners, kind.ideal) for kind in SOLID_KINDS}


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


def at_nodes(points, rows, add):
    """What `add` adds to the nodes of each cell, summed at the nodes."""
    shares, total = np.zeros((len(rows), 8, 3)), np.zeros_like(points)
    add(shares)
    np.add.at(total, rows, shares)
    return total


def check_derivatives(points, value, slopes, product):
    """Compare slopes and the product of second derivatives and a direction with differences."""
    way, step = np.random.default_rng(3).standard_normal(points.shape), 1e-6
    ahead, behind = points + step * way, points - step * way
    assert_allclose((slopes(points) * way).sum(), (value(ahead) - value(behind)) / (2 * step), rtol=1e-6)
    difference = (slopes(ahead) - slopes(behind)) / (2 * step)
    assert_allclose(product(way), difference, atol=1e-5 * np.abs(difference).max())


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
    none = np.zeros(len(rows), np.uint8)
    for norm in ((1.0, 0.0), (2.0, 0.0)):  # with an offset of 1 the power is cut off at 0
        check_derivatives(
            points,
            lambda at, p=norm[0]: ((energies(at, rows, about, delta) + 1) ** p).sum(),
            lambda at, norm=norm: at_nodes(
                at, rows, lambda to: kernels.objective.gradient(at, rows, delta, norm, none, to)
            ),
            lambda way, norm=norm: hessian_product(points, rows, way, delta, norm),
        )


def hessian_product(points, rows, way, delta, norm, target=None):
    none = np.zeros(len(rows), np.uint8)
    return at_nodes(
        points,
        rows,
        lambda to: kernels.objective.hessian_product(points, rows, rows, way, delta, norm, none, to, target),
    )


@pytest.mark.parametrize("targeted", [False, True])
@pytest.mark.parametrize("delta", [0.0, 0.3])
def test_the_patch_of_a_node_is_the_sum_of_its_cells(delta, targeted):
    points, rows, _ = mixed(seed=4, copies=1)
    shared = [row[0] for row in rows]  # one node of all cells, at another place in each
    for place, row in zip((0, 4, 4, 2), rows, strict=True):
        points[row] -= points[row[place]]
        rows[rows == row[place]] = shared[0]
    rows = rows.astype(np.int32)
    lengths = np.array([[1.0, 1.2, 0.9], [1.1, 1.1, 0.7], [0.8, 0.8, 0.8], [1.3, 1.3, 1.3]])
    target = kernels.target.TargetMatrices(1 / lengths, 0.2) if targeted else None
    start, corners = kernels.incidence.node_corners(rows, len(points))
    node = shared[0]
    star = corners[start[node] : start[node + 1]]
    assert (star // 8).tolist() == [0, 1, 2, 3]
    norm, step = (2.0, 0.0), 1e-5
    found = kernels.local.patch_energy(points, rows, star, 1.0, delta, norm, target)

    def value(y):
        moved = points.copy()
        moved[node] += y
        own = np.empty(len(rows))
        kernels.objective.energies(moved, rows, delta, 0.0, np.zeros(len(rows), np.uint8), own, target)
        return (own**2).sum()

    assert_allclose(found.value, value(np.zeros(3)), rtol=1e-12)
    unit = step * np.eye(3)
    slopes = [(value(y) - value(-y)) / (2 * step) for y in unit]
    assert_allclose(found.gradient, slopes, rtol=1e-6, atol=1e-6 * np.abs(slopes).max())
    xx, xy, xz, yy, yz, zz = found.hessian
    second = [
        [(value(a + b) - value(a - b) - value(b - a) + value(-a - b)) / (4 * step**2) for a in unit] for b in unit
    ]
    assert_allclose([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]], second, atol=2e-4 * np.abs(second).max())
    curve = np.array([[0.05, 0.0], [0.1, 0.0]])
    direction = np.array([0.3, -0.2, 0.4])
    kernels.local.energy_along(points, rows, star, 1.0, direction.tolist(), delta, norm, curve, target)
    assert_allclose(curve[:, 1], [value(alpha * direction) for alpha in curve[:, 0]], rtol=1e-12)


def assembled(points, rows, add):
    """Dense matrix of what `add` adds to blocks; all nodes are free."""
    start, corners = kernels.incidence.node_corners(rows, len(points))
    nodes = np.arange(len(points), dtype=np.int32)
    row_start, columns = kernels.sparsity.pattern(rows, nodes, start, corners, True)
    numbers = np.arange(len(rows), dtype=np.int32)
    shares = kernels.assembly.HexShares(
        np.array([0, len(points)], np.int32),
        np.array([0, len(rows)], np.int32),
        numbers,
        rows,
        nodes,
        row_start,
        columns,
    )
    off_diagonal, diagonal = np.zeros((len(columns) + 1, 9)), np.zeros((len(points), 6))
    add(shares, off_diagonal, diagonal)
    whole = np.zeros((len(points), 3, len(points), 3))
    for i in range(len(points)):
        xx, xy, xz, yy, yz, zz = diagonal[i]
        whole[i, :, i] = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]
        for k in range(row_start[i], row_start[i + 1]):
            whole[i, :, columns[k]] = off_diagonal[k].reshape(3, 3)
            whole[columns[k], :, i] = off_diagonal[k].reshape(3, 3).T
    return whole.reshape(3 * len(points), -1)


@pytest.mark.parametrize("targeted", [False, True])
@pytest.mark.parametrize("norm", [(1.0, 0.0), (2.0, 0.5)])
def test_the_assembled_hessian_is_that_of_the_product(norm, targeted):
    points, rows, _ = mixed(seed=5)
    lengths = np.random.default_rng(6).uniform(0.7, 1.3, (len(rows), 3))
    target = kernels.target.TargetMatrices(1 / lengths, 0.2) if targeted else None
    none, delta = np.zeros(len(rows), np.uint8), 0.2
    matrix = assembled(
        points,
        rows,
        lambda shares, off, own: kernels.assembly.assemble(points, delta, norm, none, shares, off, own, target),
    )
    direction = np.random.default_rng(7).standard_normal(points.shape)
    product = hessian_product(points, rows, direction, delta, norm, target)
    assert_allclose(matrix @ direction.ravel(), product.ravel(), atol=1e-11 * np.abs(matrix).max())


@pytest.mark.parametrize("targeted", [False, True])
def test_floors_and_their_derivatives(targeted):
    points, rows, _ = mixed(seed=8)
    none, q, jacobian = np.zeros(len(rows), np.uint8), np.empty(len(rows)), np.empty(len(rows))
    lengths = np.random.default_rng(9).uniform(0.8, 1.2, (len(rows), 3))
    target = kernels.target.TargetMatrices(1 / lengths) if targeted else None
    kernels.floor_barrier.qualities(points, rows, none, q, target)
    kernels.elements.measure(points, rows, *np.empty((2, len(rows))), jacobian, np.empty(len(rows)))
    floors = kernels.floor_barrier.Floors(jacobian - 0.05, q - 0.04, none, 0.2, 0.3, 1.7)

    def value(at):
        values = np.empty(len(rows))
        kernels.floor_barrier.values(at, rows, floors, none, values, target)
        return values.sum()

    def slopes(at):
        return at_nodes(at, rows, lambda to: kernels.floor_barrier.add_gradient(at, rows, floors, none, to, target))

    matrix = assembled(
        points,
        rows,
        lambda shares, off, own: kernels.floor_barrier.assemble(points, floors, none, shares, off, own, target),
    )
    check_derivatives(points, value, slopes, lambda way: (matrix @ way.ravel()).reshape(-1, 3))


def values_inside(points, row, about, n=9):
    """det J at points of a wedge or a pyramid, the latter over the square of the height that remains."""
    x, t = points[row], np.linspace(0, 1, n)
    values = []
    for u in t:
        for v in t:
            if about[0] == "pyramid":
                along_u = (1 - v) * (x[1] - x[0]) + v * (x[2] - x[3])
                along_v = (1 - u) * (x[3] - x[0]) + u * (x[2] - x[1])
                base = (1 - u) * ((1 - v) * x[0] + v * x[3]) + u * ((1 - v) * x[1] + v * x[2])
                values.append(np.linalg.det([along_u, along_v, x[4] - base]))
            elif u + v <= 1:
                for w in t:
                    a = (1 - w) * (x[1] - x[0]) + w * (x[4] - x[3])
                    b = (1 - w) * (x[2] - x[0]) + w * (x[5] - x[3])
                    c = (1 - u - v) * (x[3] - x[0]) + u * (x[4] - x[1]) + v * (x[5] - x[2])
                    values.append(np.linalg.det([a, b, c]))
    return np.array(values)


def test_the_certificate_has_the_sign_of_the_least_value_inside():
    points, rows, about = mixed(seed=11, spread=0.45, copies=60)
    found, bounds = np.empty(len(rows), np.uint8), np.empty((len(rows), 2))
    kernels.validity.certify(points, rows, found)
    kernels.validity.jacobian_bounds(points, rows, bounds)
    for i, (row, of) in enumerate(zip(rows, about, strict=True)):
        at_corners = np.linalg.det(shapes(points, row, of)).min()
        assert (found[i] == 1) == (at_corners <= 0)
        if of[0] in ("wedge", "pyramid"):
            values = values_inside(points, row, of)
            assert (values > 0).all() or found[i] != 0
            assert bounds[i, 0] <= values.min() + 1e-12
            assert bounds[i, 1] >= values.max() - 1e-12
    assert not (found == 3).any()


def test_a_wedge_that_is_valid_at_its_corners_may_be_invalid_inside():
    bottom, top = np.array([[0, 0, 0], [1, 0, 0], [0, 0.3, 0]]), np.array([[0, 0, 1], [-0.3, 0, 1], [0, -1, 1]])
    points, rows = np.concatenate([bottom, top]), np.array([row_of(range(6))], np.int32)
    sigma, found = np.empty((1, 8)), np.empty(1, np.uint8)
    kernels.elements.corner_determinants(points, rows, sigma)
    kernels.validity.certify(points, rows, found)
    assert (sigma > 0).all()
    assert found.tolist() == [2]


def test_faces_edges_and_rings_of_a_mesh_of_all_kinds():
    # A cube with a pyramid on one face, a tetrahedron on that, and a wedge on the opposite face.
    rows = np.array(
        [row_of(range(8)), row_of((12, 13, 8, 11, 10, 9)), row_of((4, 5, 6, 7, 14)), row_of((4, 5, 14, 15))], np.int32
    )
    rows[1] = row_of((0, 16, 3, 1, 17, 2))  # a wedge below the face 0 1 2 3
    start, corners = kernels.incidence.node_corners(rows, 18)
    assert len(corners) == 8 + 6 + 5 + 4
    neighbours, overlapping = kernels.incidence.face_neighbours(rows, start, corners, False)
    assert overlapping == 0
    joined = {(h, int(other)) for h in range(4) for other in neighbours[h] if other not in (-1, h)}
    assert joined == {(0, 1), (1, 0), (0, 2), (2, 0), (2, 3), (3, 2)}
    assert [(row == h).sum() for h, row in enumerate(neighbours)] == [0, 1, 1, 2]
    ring_start, ring = kernels.incidence.node_rings(rows, start, corners)
    assert ring[ring_start[14] : ring_start[15]].tolist() == [4, 5, 6, 7, 15]
    edges, valence, outside = kernels.structure.edges(rows, start, corners, neighbours)
    number = {tuple(sorted(edge)): k for k, edge in enumerate(edges.tolist())}
    assert len(number) == len(edges) == 12 + 5 + 4 + 3
    assert valence[number[4, 5]] == 3
    assert valence[number[0, 1]] == 2
    assert outside.all()


def test_element_steps_of_getme_end_at_the_ideal_cell():
    points, rows, _ = mixed(seed=12, spread=0.3)
    places, q = np.empty((len(rows), 8, 3)), np.empty(len(rows))
    for _ in range(200):
        kernels.element_step.element_steps(points, rows, 1.0, 1.0, places)
        for row, place in zip(rows, places, strict=True):
            points[row] = place[np.minimum(range(8), len(set(row)) - 1)]
    kernels.elements.measure(points, rows, q, *np.empty((3, len(rows))))
    assert_allclose(q, 1, atol=1e-6)
