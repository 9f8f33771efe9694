"""Hexes that no movement can mend: proofs, positions that free others, and real sliding runs."""

import json
import tracemalloc
from itertools import product
from shlex import quote

import numpy as np
import pytest
from scipy.optimize import linprog

import hexmend as hx
from hexmend import Mesh, io, measure, smooth
from hexmend.doctor import PROBLEMS
from hexmend.locking import Reason, find_locking, hexes_without_valid_position, nodes_without_valid_position
from hexmend.locking.locked_corners import inward_direction
from hexmend.mesh.hexahedron import FACES
from hexmend.mesh.orientation import mirror_hexes
from tests.core.grids import grid, scrambled

#: Scaled Jacobian of a hex that is flat but for rounding.
ROUNDING = 1e-6


def moved(mesh, moves):
    """Return the mesh with some nodes moved to other places."""
    points = mesh.points.copy()
    for node, place in moves.items():
        points[node] = place
    return mesh.with_points(points)


def node_at(mesh, *place):
    return int(np.flatnonzero((mesh.points == place).all(axis=1))[0])


def flat_corner():
    """Block of which a corner is cut off: a hex has two faces on the flat piece that remains, and one more edge."""
    mesh = grid(3)
    corner, edge = node_at(mesh, 0, 0, 0), [node_at(mesh, 0, 0, z) for z in range(1, 4)]
    places = {node: (0.5, 0.5, mesh.points[node, 2]) for node in [corner, *edge]}
    return moved(mesh, places)


@pytest.mark.parametrize("thin", [1e-2, 1e-4, 1e-5])
def test_corners_of_thin_hexes_between_fixed_nodes_are_not_locked(thin):
    """Along the edge of two walls, layers of both cross: hexes are thin in two directions, and sound."""
    mesh = grid(3)
    x = mesh.points.copy()
    x[:, :2] = np.array([0, thin, 0.5, 1])[x[:, :2].astype(int)]
    given = mesh.with_points(x).replace(pinned=mesh.topology.boundary)
    places = {node_at(mesh, 1, 1, z): (-0.5 * thin, -0.5 * thin, z) for z in (1, 2)}
    tangled = moved(given, places)
    assert measure(tangled.points, mesh.hexes).inverted.any()
    assert not measure(given.points, mesh.hexes).inverted.any()  # there is a movement that mends all
    assert not find_locking(tangled).hexes.size


def test_two_faces_of_a_hex_on_one_flat_patch_need_a_layer():
    mesh = flat_corner()
    locking = find_locking(mesh)
    assert locking.hexes.tolist() == [0, 9, 18]
    assert locking.hexes[locking.needs_layer].tolist() == [9]
    assert locking.hexes[locking.unmendable].tolist() == [0, 18]  # their faces at the ends have two edges on one line
    planes = [one for one in locking.corners if one.reason is Reason.PLANE]
    for one in planes:
        x = mesh.points[list(one.nodes)]
        assert np.linalg.matrix_rank(x[1:] - x[0], tol=1e-9) == 2
        assert one.sentence.endswith("lie on one flat piece of the boundary.")
    assert planes
    run = hx.smooth(
        mesh, "local-nr", boundary="slide", surface_tolerance="unlimited", max_iterations=30, keep_last=True
    )
    assert (run.mesh.points != mesh.points).any()
    assert (measure(run.mesh.points, mesh.hexes).scaled_jacobian[locking.hexes] < ROUNDING).all()
    run = hx.smooth(mesh, boundary="slide", goal="scaled-jacobian")
    assert run.after.inverted == 0  # its nodes leave the surface
    padding = hx.pad(mesh)
    assert padding.after.inverted == 2
    assert not measure(padding.mesh.points, padding.mesh.hexes).inverted[locking.hexes].any()
    assert len(padding.nodes_without_space) == 2


def test_two_edges_of_a_face_on_one_line_are_mended_by_no_layer():
    mesh = grid(3)
    corner, ends = node_at(mesh, 0, 0, 0), [node_at(mesh, 1, 0, 0), node_at(mesh, 0, 1, 0)]
    mesh = moved(mesh, {corner: mesh.points[ends].mean(axis=0)})
    locking = find_locking(mesh)
    assert locking.hexes.tolist() == [0]
    assert locking.unmendable.all()
    assert {one.nodes[0] for one in locking.corners} == {corner}
    padding = hx.pad(mesh)
    assert padding.after.inverted == 1
    assert padding.nodes_without_space.tolist() == [corner]


def test_a_corner_whose_four_nodes_stay_is_locked_by_fixed_nodes():
    mesh = grid(2).replace(pinned=np.ones(27, dtype=bool))
    mesh = moved(mesh, {13: (1.9, 1.9, 1.9)})
    locking = find_locking(mesh)
    inverted = np.flatnonzero(measure(mesh.points, mesh.hexes).inverted)
    np.testing.assert_array_equal(locking.hexes, inverted)
    assert {one.reason for one in locking.corners} == {Reason.FIXED}
    assert set(inverted) == {one.hex for one in locking.corners}
    around = moved(grid(4).replace(pinned=np.ones(125, dtype=bool)), {62: (2.9, 2.9, 2.9), 93: (1.2, 1.2, 1.2)})
    assert find_locking(around).unmendable.any()  # fixed nodes inside


@pytest.mark.parametrize("seed", range(4))
def test_no_hex_that_needs_a_layer_is_mended_by_sliding(seed):
    mesh = flat_corner()
    points = scrambled(mesh, 0.3, seed).points.copy()
    points[node_at(grid(3), 3, 3, 3)] -= 0.9  # a dent that sliding cannot mend, and one that it can
    points[node_at(grid(3), 3, 1, 1)] += [0, 1.5, 0]
    mesh = mesh.with_points(points)
    locking = find_locking(mesh)
    assert locking.needs_layer.any()
    run = hx.smooth(mesh, boundary="slide", surface_tolerance="unlimited", goal="scaled-jacobian", max_iterations=30)
    proven = locking.hexes[locking.needs_layer | locking.unmendable]
    assert (measure(run.mesh.points, mesh.hexes).scaled_jacobian[proven] < ROUNDING).all()


def test_sliding_may_free_the_bunny(real_mesh):
    locking = find_locking(hx.read(real_mesh("bunny.vtk")))
    assert locking.hexes.size == 44
    assert locking.undecided.all()  # the published result frees all of them


def test_info_prints_what_frees_locked_hexes_and_lists_the_proofs(tmp_path, run_command):
    path = tmp_path / "cut.vtu"
    io.write(path, flat_corner())
    printed = run_command("info", path, "--doctor").out
    assert "3 locked; 1 needs another layer; 2 that neither mends." in printed
    assert "Hex 0 at node" in printed
    assert f"hexmend pad {quote(str(path))} -o OUT" in printed
    values = json.loads(run_command("info", path, "--json").out)["locking"]
    assert (values["need_layer"], values["unmendable"]) == ([9], [0, 18])
    assert all(len(one["nodes"]) == 4 for one in values["corners"])


# Hexes that no position of the nodes makes valid: corners on one side of two faces with the same two edges.


def around_two_faces(*hexes):
    """Make hexes above and below two faces with the edges 0-1 and 0-3 in common: pairs of face, 0 or 1, and side."""
    points = [[0, 0, 0], [1, 0, 0], [0.8, 0.8, 0], [0, 1, 0], [1, 1, 0.1]]
    faces, rows = ([0, 1, 2, 3], [0, 1, 4, 3]), []
    for face, side in hexes:
        corners = np.array(points)[faces[face]]
        others = list(range(len(points), len(points) + 4))
        points += (corners + [0, 0, side * (1 + 0.2 * face)]).tolist()
        lower, upper = (faces[face], others) if side > 0 else (others, faces[face])
        rows.append([*lower, *upper])
    return Mesh(np.array(points), rows)


def brute_force(mesh):
    """Find nodes and hexes from a table of the faces at each node."""
    table = {}
    for h, face, p in product(range(mesh.n_hexes), FACES, range(4)):
        node, after, across, before = mesh.hexes[h, np.roll(face, -p)].tolist()
        if len({node, after, before}) == 3:
            table.setdefault((node, after, before), []).append((across, h))
    several = {key: rows for key, rows in table.items() if len({across for across, _ in rows}) > 1}
    return sorted({key[0] for key in several}), sorted({h for rows in several.values() for _, h in rows})


def test_hexes_on_one_side_of_two_faces_with_the_same_edges_are_found_and_named():
    mesh = around_two_faces((0, 1), (0, -1), (1, 1), (1, -1))
    assert (mesh.topology.face_neighbours >= 0).sum() == 4
    assert hexes_without_valid_position(mesh).tolist() == [0, 1, 2, 3]
    assert nodes_without_valid_position(mesh).tolist() == [0]
    finding = PROBLEMS["overlapping-corners"].find(mesh)
    assert "hexes 0, 1, 2, 3" in finding.message
    assert "node 0" in finding.message
    assert finding.nodes.tolist() == [0]
    assert not finding.mendable


@pytest.mark.parametrize("hexes", [[(0, 1), (0, -1)], [(0, 1), (1, -1)], [(1, 1), (0, -1)]])
def test_hexes_on_both_sides_of_one_face_or_of_a_gap_between_two_are_none(hexes):
    assert not hexes_without_valid_position(around_two_faces(*hexes)).size


def test_a_lattice_has_none_however_its_hexes_are_numbered_and_moved():
    mesh, random = grid(3), np.random.default_rng(1)
    wrong = mirror_hexes(mesh, random.random(27) < 0.5)
    tangled = mesh.with_points(random.random(mesh.points.shape))
    twice = Mesh(mesh.points, np.concatenate([mesh.hexes, mesh.hexes[:3]]))
    for one in (mesh, wrong, tangled, twice):
        assert not hexes_without_valid_position(one).size


@pytest.mark.parametrize("seed", range(5))
def test_the_pass_over_corners_finds_what_a_table_of_faces_finds(seed):
    random = np.random.default_rng(seed)
    mesh = grid(4, 3, 3)
    same = np.arange(mesh.n_nodes)
    chosen = random.choice(mesh.n_nodes, 12, replace=False)
    same[chosen[:6]] = chosen[6:]  # collapses hexes and joins distant ones
    mesh = Mesh(mesh.points, same[mesh.hexes])
    nodes, hexes = brute_force(mesh)
    assert hexes
    assert nodes_without_valid_position(mesh).tolist() == nodes
    assert hexes_without_valid_position(mesh).tolist() == hexes


def test_a_run_that_leaves_such_hexes_inverted_says_that_no_position_makes_them_valid():
    mesh = around_two_faces((0, 1), (0, -1), (1, 1), (1, -1))
    points = mesh.points.copy()
    points[mesh.hexes[2, 4:]] *= [1, 1, -0.5]  # the third hex lies below its face
    mesh = mesh.with_points(points)
    assert measure(mesh.points, mesh.hexes).n_inverted > 0
    assert (
        "No position of the nodes makes all of 4 hexes valid without overlap: hexes 0, 1, 2, 3." in smooth(mesh).message
    )


@pytest.mark.slow
def test_with_a_boundary_that_slides_one_hex_stays_invalid_at_each_such_node(real_mesh):
    mesh = io.read(real_mesh("sd_kitten.mesh"))
    result = smooth(mesh, "mend", boundary="slide")
    assert result.after.invalid == nodes_without_valid_position(mesh).size
    assert result.after.scaled_jacobian_min >= result.before.scaled_jacobian_min


# Nodes at which the boundary leaves no space for the hexes of a layer.


@pytest.mark.parametrize("seed", range(60))
def test_a_direction_below_all_faces_is_found_where_there_is_one(seed):
    random = np.random.default_rng(seed)
    normals = random.normal(size=(random.integers(1, 8), 3)) + [0, 0, 0.7]
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    below = np.column_stack([normals, np.ones(len(normals))])
    found = linprog([0, 0, 0, -1], A_ub=below, b_ub=np.zeros(len(normals)), bounds=[(-1, 1)] * 3 + [(None, 1)])
    direction, sine = inward_direction(normals)
    assert (sine > 1e-6) == (-found.fun > 1e-6)
    assert (normals @ direction).max() == pytest.approx(-sine)


def test_memory_for_a_node_of_many_faces_does_not_grow_with_their_triples():
    angle = np.linspace(0, 2 * np.pi, 120, endpoint=False)
    shares = np.where(np.arange(120) % 2, np.random.default_rng(0).random(120), 1.0)
    normals = np.column_stack([shares * np.cos(angle), shares * np.sin(angle), np.full(120, 0.5)])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    tracemalloc.start()
    direction, sine = inward_direction(normals)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    np.testing.assert_allclose(direction, [0, 0, -1], atol=1e-12)
    assert sine == pytest.approx(0.5 / np.hypot(1, 0.5))
    assert peak < 1e7  # 280,840 triples of normals take 200 MB


def test_faces_without_area_leave_no_space():
    assert inward_direction(np.zeros((1, 3)))[1] <= 0
    assert inward_direction(np.array([[0, 0, 1.0], [0, 0, -1.0]]))[1] <= 0
    assert inward_direction(np.array([[0, 0, 1.0], [0, 0, 1.0]]))[1] == 1
