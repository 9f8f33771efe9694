"""Hexes that no movement can mend: proofs, positions that free others, and real sliding runs."""

import json
from shlex import quote

import numpy as np
import pytest

import hexmend as hx
from hexmend import io, measure
from hexmend.locking import Reason, find_locking
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
