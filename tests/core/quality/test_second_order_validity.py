"""Validity of hexes of 20 and 27 nodes, and what the command line says of invalid hexes."""

import json

import numpy as np
import pytest

from hexmend import Mesh, io, iterate, measure, summarise
from hexmend.cli.main import main
from hexmend.doctor import PROBLEMS
from hexmend.mesh.hexahedron import UNIT_CUBE
from hexmend.mesh.second_order import MID_NODE_WEIGHTS, NODE_POSITIONS, jacobian_range, lagrange
from hexmend.mesh.second_order.curved_geometry import hex_nodes
from hexmend.quality.validity import Validity, certify, jacobian_bounds, least_jacobian
from hexmend_app.scene.geometry.curved_elements import jacobian_field
from tests.core.grids import grid, scrambled, with_edge_midpoints
from tests.core.quality.test_validity import BETWEEN, random_hexes, separate

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
