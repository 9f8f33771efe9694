"""Validity of hexes, against subdivision in whole numbers of any length, and what must not change it."""

import json
from itertools import product

import numpy as np
import pytest

from hexmend import Mesh, io, iterate, measure, summarise
from hexmend.cli.main import main
from hexmend.doctor import PROBLEMS
from hexmend.mesh.hexahedron import UNIT_CUBE
from hexmend.mesh.second_order import MID_NODE_WEIGHTS, NODE_POSITIONS, jacobian_range, lagrange
from hexmend.mesh.second_order.curved_geometry import hex_nodes
from hexmend.quality import corner_determinants
from hexmend.quality.validity import Validity, certify, jacobian_bounds, least_jacobian
from hexmend_app.scene.geometry.curved_elements import jacobian_field
from tests.core.grids import grid, scrambled, with_edge_midpoints

CORNERS = UNIT_CUBE.astype(int)
#: All corners are positive, and det J is negative within the edge of x = 1, z = 1, but not at its middle.
BETWEEN = np.array([[0, 0, 1], [4, 0, 2], [3, 4, 0], [0, 5, -1], [0, -3, 4], [2, 2, 6], [5, 3, 3], [0, 5, 5]])
#: det J is positive but at a third of an edge, where it is 0.
TOUCHING = np.array([[1, 3, -3], [4, 1, 3], [2, 4, -2], [2, 5, -1], [3, 1, 4], [4, 2, 4], [6, 4, 2], [0, 5, 5]])

#: Twice the Bernstein coefficients of a parabola from its values at 0, 1/2 and 1; four times those of its halves.
TO_BERNSTEIN = np.array([[2, 0, 0], [-1, 4, -1], [0, 0, 2]])
HALVES = np.array([[4, 0, 0], [2, 2, 0], [1, 2, 1]]), np.array([[1, 2, 1], [0, 2, 2], [0, 0, 4]])


def along_axes(x, y, z):
    """A matrix (27, 27) that applies three matrices (3, 3) along the axes of coefficients (27,)."""
    return np.kron(np.kron(x, y), z).astype(object)


PARTS = [along_axes(*axes) for axes in product(HALVES, repeat=3)]


def coefficients(x):
    """Bernstein coefficients (27,) of det J of a hex (8, 3) of whole numbers, times a power of two."""
    values = []
    for at in product((0, 1, 2), repeat=3):  # twice the coordinates
        factors = np.where(CORNERS == 1, at, 2 - np.array(at))
        columns = [[int(v) for v in (np.delete(factors, k, 1).prod(1) * (2 * CORNERS[:, k] - 1)) @ x] for k in range(3)]
        (a, b, c), (d, e, f), (g, h, i) = columns
        values.append(a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g))
    return along_axes(*[TO_BERNSTEIN] * 3) @ np.array(values, dtype=object)


def exact_validity(x, levels=12):
    """Validity of a hex (8, 3) of whole numbers, by subdivision without rounding."""
    whole = coefficients(x)
    if corners(whole).min() <= 0:
        return Validity.INVERTED
    boxes, found = [(whole, 0)], Validity.VALID
    while boxes:
        box, level = boxes.pop()
        if box.min() > 0:
            continue
        if corners(box).min() <= 0:
            return Validity.INVALID_INSIDE
        if level == levels:
            found = Validity.UNDECIDED
        else:
            boxes += [(part @ box, level + 1) for part in PARTS]
    return found


def corners(box):
    return box.reshape(3, 3, 3)[::2, ::2, ::2]


def separate(hexes):
    """Points (8 m, 3) and hexes (m, 8) without common nodes, of corners (m, 8, 3)."""
    points = np.ascontiguousarray(np.asarray(hexes, float).reshape(-1, 3))
    return points, np.arange(len(points), dtype=np.int32).reshape(-1, 8)


def random_hexes(count, seed, moved=40, scale=(64, 64, 64)):
    """Cubes whose corners are moved at random, (count, 8, 3) of whole numbers."""
    shift = np.random.default_rng(seed).integers(-moved, moved + 1, (count, 8, 3))
    return np.array(scale) * CORNERS + shift * np.array(scale) // 64


def values_on_grid(x, divisions):
    """det J (m, d, d, d) of hexes (m, 8, 3) on a regular grid, and the greatest coefficient of each."""
    t = np.linspace(0, 1, divisions + 1)
    basis = np.column_stack([(1 - t) ** 2, 2 * t * (1 - t), t**2])
    exact = np.array([coefficients(one) for one in x.astype(int)]).astype(float) / 512
    values = np.einsum("ia,jb,kc,nabc->nijk", basis, basis, basis, exact.reshape(-1, 3, 3, 3), optimize=True)
    return values, np.abs(exact).max(axis=1)


@pytest.mark.parametrize(
    ("moved", "scale"),
    [(36, (64, 64, 64)), (40, (64, 64, 64)), (30, (4096, 4096, 64)), (40, (2**20, 64, 64)), (36, (2**16, 2**10, 64))],
)
def test_every_hex_has_the_validity_of_exact_subdivision(moved, scale):
    x = random_hexes(150, moved, moved, scale)
    expected = [exact_validity(one) for one in x]
    assert certify(*separate(x)).tolist() == expected
    assert {Validity.VALID, Validity.INVERTED, Validity.INVALID_INSIDE} <= set(expected)


def test_nearly_flat_hexes_that_lean_have_the_validity_of_exact_subdivision():
    x = random_hexes(100, 5, 30, (1024, 1024, 64)) @ [[1, 0, 900], [0, 1, -700], [0, 0, 1]]
    assert certify(*separate(x)).tolist() == [exact_validity(one) for one in x]


def test_bounds_contain_every_value_and_are_as_near_as_is_promised():
    x, divisions = random_hexes(60, 7), 64
    bounds = jacobian_bounds(*separate(x))
    values, scale = values_on_grid(x, divisions)
    least, greatest = values.min(axis=(1, 2, 3)), values.max(axis=(1, 2, 3))
    rounding, unseen = 1e-13 * scale, 3 / divisions**2 * scale  # a second derivative is at most 8 times the scale
    for bound, extreme, outward in ((bounds[:, 0], least, -1), (bounds[:, 1], greatest, 1)):
        beyond = outward * (bound - extreme)
        assert (beyond >= -rounding).all()
        assert (beyond <= np.maximum(0.01 * np.abs(extreme), 1e-7 * scale) + 1.01 * unseen).all()


def test_the_least_jacobian_is_that_of_the_worst_hex():
    x = random_hexes(40, 3, 20)
    points, hexes = separate(x)
    bounds = jacobian_bounds(points, hexes)
    ratios = bounds[:, 0] / np.abs(bounds).max(axis=1)
    assert least_jacobian(points, hexes) == ratios.min()
    valid = np.ascontiguousarray(hexes[ratios > 0])
    assert 0 < least_jacobian(points, valid) == ratios[ratios > 0].min() < 1
    assert least_jacobian(*separate([UNIT_CUBE @ [[3, 0, 0], [1, 2, 0], [0, 1, 1]]])) == pytest.approx(1)


@pytest.mark.parametrize("factor", [2.0**-200, 2.0**-80, 0.5, 2.0**100, 2.0**200, 2.0**300])
def test_validity_does_not_depend_on_the_unit_of_length_or_the_place(factor):
    points, hexes = separate(random_hexes(300, 12, 36))
    expected, bounds = certify(points, hexes), jacobian_bounds(points, hexes)
    assert certify(factor * points, hexes).tolist() == expected.tolist()
    assert (jacobian_bounds(factor * points, hexes) == factor**3 * bounds).all()
    assert certify(points + [2**20, -(2**21), 2**19], hexes).tolist() == expected.tolist()


def test_a_hex_with_positive_corners_may_be_invalid_inside():
    points, hexes = separate([BETWEEN])
    assert corner_determinants(points, hexes).min() > 0
    quality = measure(points, hexes)
    assert (quality.n_inverted, quality.n_invalid, quality.validity[0]) == (0, 1, Validity.INVALID_INSIDE)
    assert exact_validity(BETWEEN) == Validity.INVALID_INSIDE
    assert least_jacobian(points, hexes) < 0


@pytest.mark.parametrize("stretch", [1.5, 2.0, 3.0])
def test_a_hex_whose_upper_face_is_turned_by_180_degrees_and_stretched_is_invalid_at_half_its_height(stretch):
    """The layer at z has the map (1 - z) I + z diag(-s, -1/s), of determinant 1 - (2 + s + 1/s) z (1 - z)."""
    x = UNIT_CUBE.copy()
    x[4:, :2] *= [-stretch, -1 / stretch]
    least = 1 - (2 + stretch + 1 / stretch) / 4
    points, hexes = separate([x])
    assert corner_determinants(points, hexes).min() == pytest.approx(1)
    assert certify(points, hexes)[0] == Validity.INVALID_INSIDE
    np.testing.assert_allclose(jacobian_bounds(points, hexes), [[least, 1]], rtol=0.01, atol=1e-7)


def test_a_hex_whose_jacobian_touches_zero_is_undecided_and_counts_as_invalid():
    quality = measure(*separate([TOUCHING]))
    assert exact_validity(TOUCHING) == Validity.UNDECIDED
    assert (quality.n_inverted, quality.n_invalid, quality.n_undecided) == (0, 1, 1)


DEGENERATE = {
    "flat": UNIT_CUBE * [1, 1, 0],
    "mirrored": UNIT_CUBE * [-1, 1, 1],
    "point": np.zeros((8, 3)),
    "collapsed-edge": UNIT_CUBE[[0, 0, 2, 3, 4, 5, 6, 7]],
    "collapsed-face": UNIT_CUBE[[0, 1, 2, 3, 0, 1, 2, 3]],
    "tiny": 1e-110 * UNIT_CUBE,
    "large": 1e103 * UNIT_CUBE,
    "larger": 1e200 * UNIT_CUBE,
    "larger-uneven": 1e200 * (UNIT_CUBE + 0.1 * np.random.default_rng(1).normal(size=(8, 3))),
    "random": 1e300 * np.random.default_rng(2).normal(size=(8, 3)),
}


@pytest.mark.parametrize("corners", DEGENERATE.values(), ids=DEGENERATE)
def test_a_degenerate_hex_counts_as_invalid(corners):
    points, hexes = separate([corners])
    assert certify(points, hexes)[0] != Validity.VALID
    assert -1 <= least_jacobian(points, hexes) <= 0
    assert jacobian_bounds(points, hexes)[0, 0] <= 0
    assert measure(points, hexes).n_invalid == 1


@pytest.mark.parametrize("edge", [1e-100, 1e-60, 1e52, 1e100])
def test_a_cube_of_any_size_whose_volume_is_a_number_is_valid(edge):
    assert certify(*separate([edge * UNIT_CUBE]))[0] == Validity.VALID


def test_the_field_of_a_hex_is_the_determinant_at_each_point():
    positions, determinants = jacobian_field(BETWEEN.astype(float), 4)
    np.testing.assert_allclose(determinants, values_on_grid(BETWEEN[None], 4)[0][0], rtol=1e-12, atol=1e-12)
    np.testing.assert_array_equal(positions[4, 0, 4], BETWEEN[5])


def test_the_least_jacobian_is_a_lower_bound_and_depends_on_no_order_of_hexes():
    x = random_hexes(400, 5, moved=48)
    points, hexes = separate(x)
    alone = [least_jacobian(points, hexes[[h]]) for h in range(len(hexes))]
    assert least_jacobian(points, hexes) == least_jacobian(points, hexes[::-1].copy()) == min(alone)
    for value, on_grid in zip(alone, values_on_grid(x, 8)[0], strict=True):
        assert value <= on_grid.min() / max(-on_grid.min(), on_grid.max()) + 1e-12


# Validity of hexes of 20 and 27 nodes, and what the command line says of invalid hexes.


#: Mid-nodes and their moves, in sixteenths of the edge of a cube, that fold it between all nodes and Gauss points.
FOLDED = {20: {11: [8, -3, 6]}, 27: {17: [0, 3, 1], 20: [5, -4, 0]}}

every_width = pytest.mark.parametrize("width", [20, 27])


def second_order(nodes):
    """A mesh of hexes without common nodes, of the positions of their nodes, (m, 20 or 27, 3)."""
    m, width = nodes.shape[:2]
    numbers = np.arange(m * width, dtype=np.int32).reshape(m, width)
    mid_nodes = np.full((m, 19), -1, np.int32)
    mid_nodes[:, : width - 8] = numbers[:, 8:]
    return Mesh(nodes.reshape(-1, 3), np.ascontiguousarray(numbers[:, :8]), mid_nodes=mid_nodes)


def folded(width):
    nodes = NODE_POSITIONS[:width].copy()
    for node, move in FOLDED[width].items():
        nodes[node] += np.array(move) / 16
    return second_order(nodes[None])


@every_width
def test_a_straight_hex_of_second_order_has_the_validity_of_its_corners(width):
    corners = random_hexes(300, 21, 36).astype(float)
    mesh = second_order(np.concatenate([corners, MID_NODE_WEIGHTS[: width - 8] @ corners], axis=1))
    expected = certify(*separate(corners))
    assert len(np.unique(expected)) == 3
    assert certify(mesh.points, mesh.hexes, mesh.mid_nodes).tolist() == expected.tolist()


@every_width
def test_a_hex_that_is_folded_between_nodes_and_gauss_points_is_found(width):
    mesh = folded(width)
    nodes = hex_nodes(mesh.points, mesh.hexes, mesh.mid_nodes)[0]
    assert jacobian_range(mesh.points, mesh.hexes, mesh.mid_nodes)[0, 0] > 0.05  # at nodes and Gauss points
    assert jacobian_field(nodes, 48)[1].min() < -0.03
    quality = measure(mesh.points, mesh.hexes, mesh.mid_nodes)
    assert (quality.n_inverted, quality.validity[0]) == (0, Validity.INVALID_INSIDE)
    assert measure(mesh.points, mesh.hexes).n_invalid == 0  # of the corners alone
    assert PROBLEMS["mid-nodes"].find(mesh) is not None


def test_the_field_of_a_curved_hex_is_the_determinant_at_each_point():
    nodes = NODE_POSITIONS + np.random.default_rng(4).uniform(-0.1, 0.1, (27, 3))
    positions, determinants = jacobian_field(nodes, 3)
    at = np.stack(np.meshgrid(*[np.arange(4) / 3] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
    values, gradients = lagrange(at, NODE_POSITIONS)
    np.testing.assert_allclose(positions.reshape(-1, 3), values @ nodes, atol=1e-12)
    expected = np.linalg.det(np.einsum("gnd,nx->gdx", gradients, nodes))
    np.testing.assert_allclose(determinants.ravel(), expected, rtol=1e-12)


@every_width
def test_bounds_of_curved_hexes_contain_every_value_and_are_near(width):
    random = np.random.default_rng(5)
    mesh = second_order(NODE_POSITIONS[:width] + random.uniform(-0.08, 0.08, (12, width, 3)))
    bounds = jacobian_bounds(mesh.points, mesh.hexes, mesh.mid_nodes)
    for nodes, (low, high) in zip(hex_nodes(mesh.points, mesh.hexes, mesh.mid_nodes), bounds, strict=True):
        values = jacobian_field(nodes, 32)[1]
        least, greatest, rounding = values.min(), values.max(), 1e-13 * values.max()
        assert low - rounding <= least <= low + 0.03 * greatest
        assert high - 0.03 * greatest <= greatest <= high + rounding
    assert least_jacobian(mesh.points, mesh.hexes, mesh.mid_nodes) == (bounds[:, 0] / np.abs(bounds).max(axis=1)).min()


def test_hexes_of_first_and_second_order_are_judged_by_their_own_maps():
    points = np.concatenate([folded(20).points, UNIT_CUBE + 5, BETWEEN + 20.0])
    hexes = np.array([range(8), range(20, 28), range(28, 36)], dtype=np.int32)
    mid_nodes = np.full((3, 19), -1, np.int32)
    mid_nodes[0, :12] = range(8, 20)
    assert certify(points, hexes, mid_nodes).tolist() == [2, 0, 2]
    assert certify(points, hexes).tolist() == [0, 0, 2]


def test_iterations_of_a_second_order_mesh_are_judged_with_its_mid_nodes_moved():
    """Where the mid-nodes stayed behind, each step would make hexes invalid, and the mesh as given would be kept."""
    mesh = with_edge_midpoints(scrambled(grid(4), 0.3))
    for iteration in iterate(mesh, "laplacian"):
        moved = mesh.with_points(iteration.points)
        np.testing.assert_array_equal(iteration.points, moved.points)
        assert iteration.invalid == summarise(moved).invalid
    assert iteration.number > 1
    assert iteration.invalid == 0


def test_info_and_smooth_count_hexes_that_are_invalid_inside(tmp_path, capsys, run_command):
    path, out, report = (str(tmp_path / name) for name in ("mesh.vtu", "out.vtu", "report.json"))
    io.write(path, Mesh(*separate([UNIT_CUBE, BETWEEN + 10.0])))
    figures = json.loads(run_command("info", path, "--json").out)
    assert (figures["inverted"], figures["invalid"]) == (0, 1)
    assert figures["min_jacobian"] < 0
    main(["info", path])
    assert "1 of 2 hexes is invalid inside, between positive corners." in capsys.readouterr().out
    assert "1 hex still invalid inside" in run_command("smooth", path, "-o", out, "--json", report, status=4).out
    for figures in (json.loads((tmp_path / "report.json").read_text())[time] for time in ("before", "after")):
        assert (figures["inverted"], figures["invalid"]) == (0, 1)
        assert figures["min_jacobian"] < 0


@pytest.mark.slow
def test_no_hex_of_the_real_meshes_is_undecided(real_mesh):
    folder = real_mesh("CAD4.vtk").parent
    invalid = {}
    for path in sorted(folder.iterdir()):
        if path.is_file() and path.suffix != ".md":
            mesh = io.read(path)
            quality = measure(mesh.points, mesh.hexes, mesh.mid_nodes)
            assert quality.n_undecided == 0, path.name
            invalid[path.name] = quality.n_invalid - quality.n_inverted
    assert invalid["sd_inside_only_12.vtk"] == invalid["Dolphin_2.mesh"] == 2
