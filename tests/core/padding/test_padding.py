"""Layers of hexes: the boundary stays, the mesh is conforming, and sets, data and mid-nodes are carried on."""

import json

import numpy as np
import pytest

import hexmend as hx
from hexmend import Cells, Mesh, MeshError, ParameterError, io
from hexmend.mesh.hexahedron import FACES, UNIT_CUBE
from hexmend.mesh.second_order import MID_EDGES, MID_NODE_WEIGHTS
from hexmend.padding import around_sheet, padded_mesh, whole_sheet
from hexmend.padding.inserted_layer import CrossingError
from hexmend.padding.mid_nodes import CENTRES, SIDE_COLUMNS
from hexmend.quality.material_volumes import material_volumes
from tests.core.grids import grid, placed, scrambled
from tests.core.padding.conforming import area_of_sides, check_layer, sides_where, sorted_rows


def cubes(*places):
    """Mesh of unit cubes with their lowest corners at some places, and with common nodes."""
    nodes, number = np.unique(np.concatenate([UNIT_CUBE + place for place in places]), axis=0, return_inverse=True)
    return Mesh(nodes, number.reshape(-1, 8))


SLOW = [pytest.param(name, marks=pytest.mark.slow) for name in ("five-side", "layered", "plane")]


@pytest.mark.parametrize("name", ["bridge-sharp", "materials", *SLOW])
def test_every_gallery_mesh_is_padded_and_mended(name):
    mesh = hx.gallery.make(name, size=200)
    if name == "plane":
        mesh = mesh.replace(side_set_types={})
    padding = hx.pad(mesh)
    check_layer(mesh, padding.mesh)
    assert len(padding.layer) == len(mesh.topology.boundary_faces)
    assert padding.after.inverted == 0
    assert padding.mesh.fixed[: mesh.n_nodes][mesh.topology.boundary].all()


def test_a_locked_hex_is_mended_with_the_boundary_as_it_is():
    mesh = grid(3)
    mesh = placed(mesh, 0, [0.9, 0.9, 0.9])  # a corner pushed through the plane of its neighbours
    assert hx.smooth(mesh).after.locked_inverted == 1
    padding = hx.pad(mesh, around="locked")
    check_layer(mesh, padding.mesh)
    assert len(padding.layer) < len(mesh.topology.boundary_faces)


@pytest.mark.slow
@pytest.mark.parametrize("around", [None, "locked"])
def test_the_bunny_is_mended_at_distance_0(real_mesh, around):
    mesh = hx.read(real_mesh("bunny.vtk"))
    padding = hx.pad(mesh, around=around)
    assert (padding.before.locked_inverted, padding.after.inverted) == (44, 0)
    check_layer(mesh, padding.mesh)


def test_the_default_thickness_is_a_third_of_the_edges_behind():
    padded = hx.pad(grid(4), mend=False)
    x = padded.mesh.points[padded.mesh.n_nodes - 98 :]
    np.testing.assert_allclose(np.abs(x - 2).max(axis=1), 2 - 1 / 3, rtol=1e-3)
    assert padded.after.inverted == 0


@pytest.mark.parametrize("thickness", [0.05, 0.2])
def test_a_thickness_is_kept_by_mending(thickness):
    padding = hx.pad(scrambled(grid(4), 0.2), thickness=thickness)
    assert padding.thickness == pytest.approx(thickness, rel=0.3)
    assert padding.thickness.mean() == pytest.approx(thickness, rel=0.1)
    assert padding.mesh.element_target is None


def test_materials_go_on_through_the_layer():
    mesh = grid(4)
    low = np.flatnonzero(mesh.points[mesh.hexes].mean(axis=1)[:, 0] < 2)
    mesh = mesh.replace(hex_data={"material": np.isin(np.arange(64), low).astype(int), "id": np.arange(1, 65)})
    padding = hx.pad(mesh)
    padded = padding.mesh
    check_layer(mesh, padded)
    assert padding.after.inverted == 0
    volumes = {name: 32 * one for name, one in material_volumes(mesh).items()}
    assert {name: 32 * one for name, one in material_volumes(padded).items()} == pytest.approx(volumes)
    between = padded.points[padded.materials.interface_nodes]
    np.testing.assert_allclose(between[:, 0], 2)
    assert sorted(padded.hex_data["id"]) == list(range(1, padded.n_hexes + 1))


def test_sides_pass_to_the_layer_and_sides_inside_go_on_through_it():
    mesh = grid(4)
    inside = np.array([[h, 1] for h in range(64) if h % 4 == 1])
    sets = {"x": sides_where(mesh, lambda c: c[:, 0] == 0), "middle": inside, "part": inside[:4]}
    mesh = mesh.replace(side_sets=sets, side_set_types={"x": "wall"})
    padded = hx.pad(mesh).mesh
    assert area_of_sides(padded, "x") == pytest.approx(16)
    assert area_of_sides(padded, "middle") == pytest.approx(16)
    assert (padded.side_sets["x"][:, 0] >= 64).all()
    for name, place in ("x", 0), ("middle", 2):
        rows = padded.side_sets[name]
        x = padded.points[padded.hexes[rows[:, :1], FACES[rows[:, 1]]]]
        np.testing.assert_allclose(x[..., 0], place, atol=0.3)
    assert padded.side_set_types == {"x": "wall"}


def test_node_sets_on_the_boundary_stay_and_others_go_on():
    mesh = grid(4)
    on = {name: np.flatnonzero(mesh.points[:, 0] == place) for name, place in (("wall", 0), ("middle", 2))}
    mesh = mesh.replace(node_sets={**on, "all": np.arange(mesh.n_nodes)})
    padded = hx.pad(mesh, mend=False).mesh
    np.testing.assert_array_equal(padded.node_sets["wall"], on["wall"])
    assert len(padded.node_sets["middle"]) == 25 + 16
    assert padded.points[padded.node_sets["middle"]][:, 0] == pytest.approx(2)
    assert len(padded.node_sets["all"]) == padded.n_nodes


def test_data_of_nodes_are_interpolated_and_ids_go_on():
    mesh = grid(4)
    data = {"id": np.arange(10, 10 + mesh.n_nodes), "x": mesh.points.copy(), "ref": mesh.topology.boundary.astype(int)}
    padded = hx.pad(mesh.replace(node_data=data), mend=False).mesh
    ids = padded.node_data["id"]
    assert len(np.unique(ids)) == len(ids)
    np.testing.assert_array_equal(ids[: mesh.n_nodes], data["id"])
    faces = padded.node_data["ref"][mesh.n_nodes :] == 0
    assert np.count_nonzero(faces) == 6 * 9  # all copies but those under edges have a node inside behind them
    np.testing.assert_allclose(padded.node_data["x"][mesh.n_nodes :][faces], padded.points[mesh.n_nodes :][faces], 1e-3)


@pytest.mark.parametrize(("dtype", "after"), [(np.uint8, np.int64), (np.int16, np.int16)])
def test_ids_of_a_type_that_cannot_go_on_get_a_larger_one(dtype, after):
    mesh = grid(5)
    data = {"id": np.arange(100, 225, dtype=dtype)}
    ids = hx.pad(mesh.replace(hex_data=data), mend=False).mesh.hex_data["id"]
    assert ids.dtype == after
    np.testing.assert_array_equal(ids, np.arange(100, 100 + len(ids)))


def test_quads_and_lines_on_the_boundary_stay_and_those_inside_go_on():
    mesh = grid(4)
    inside = np.array([mesh.hexes[h, FACES[1]] for h in range(64) if h % 4 == 1])
    quads = Cells("quad", np.concatenate([mesh.topology.boundary_faces, inside]), {"id": np.arange(112)}, {
        "cut": np.arange(96, 112),
    })  # fmt: skip
    row = np.flatnonzero((mesh.points[:, 1:] == 2).all(axis=1))
    rim = np.flatnonzero((mesh.points[:, 1:] == 0).all(axis=1))
    lines = Cells("line", np.concatenate([np.column_stack([one[:-1], one[1:]]) for one in (row, rim)]))
    padded = hx.pad(mesh.replace(cells=(quads, lines)), mend=False).mesh
    quads, lines = padded.cells
    assert sorted_rows(quads.nodes[:96]) == sorted_rows(mesh.topology.boundary_faces)
    cut = quads.nodes[quads.sets["cut"]]
    sides = set(sorted_rows(padded.hexes[:, FACES].reshape(-1, 4)))
    assert len(cut) == 32
    assert set(sorted_rows(cut)) <= sides
    assert padded.points[cut][..., 0] == pytest.approx(2)
    area = np.cross(*(padded.points[cut[:, k]] - padded.points[cut[:, 0]] for k in (1, 3)))
    assert (area[:, 0] > 0).all() or (area[:, 0] < 0).all()  # all look one way
    assert len(np.unique(quads.data["id"])) == 128
    lengths = np.linalg.norm(np.diff(padded.points[lines.nodes], axis=1)[:, 0], axis=1)
    assert lengths.sum() == pytest.approx(8)
    assert len(lines.nodes) == 10


@pytest.mark.parametrize("order", [20, 27])
def test_second_order_is_carried(order):
    mesh = grid(2)
    x = mesh.points[mesh.hexes]
    mids, positions, at = np.full((8, 19), -1), [*mesh.points], {}
    for h, k in np.ndindex(8, order - 8):
        place = tuple(np.round(MID_NODE_WEIGHTS[k] @ x[h], 6))
        if place not in at:
            at[place] = len(positions)
            positions.append(place)
        mids[h, k] = at[place]
    points = np.array(positions) + 0.05 * np.sin(3 * np.array(positions)[:, [1, 2, 0]])
    mesh = Mesh(points, mesh.hexes, mid_nodes=mids)
    padded = hx.pad(mesh).mesh
    assert (padded.mid_nodes >= 0).sum(axis=1).tolist() == [order - 8] * padded.n_hexes
    check_layer(mesh, padded)
    np.testing.assert_array_equal(padded.points[: len(points)][_skin_nodes(mesh)], points[_skin_nodes(mesh)])
    straight = padded.points[padded.hexes[:, MID_EDGES]].mean(axis=2)
    np.testing.assert_allclose(padded.points[padded.mid_nodes[:, :12]], straight, atol=0.05)
    assert sorted_rows(_skin_mids(padded)) == sorted_rows(_skin_mids(mesh))


def _skin_mids(mesh):
    """Mid-nodes of the boundary faces, -1 for none, (k, 5)."""
    hexes, faces = np.nonzero(mesh.topology.face_neighbours < 0)
    columns = np.column_stack([SIDE_COLUMNS[faces], CENTRES + faces])
    return mesh.mid_nodes[hexes[:, None], columns]


def _skin_nodes(mesh):
    mids = np.unique(_skin_mids(mesh))
    return np.concatenate([np.flatnonzero(mesh.topology.boundary), mids[mids >= 0]])


def test_hexes_that_touch_in_an_edge_or_node_get_layers_of_their_own():
    for places in ([0, 0, 0], [1, 1, 0]), ([0, 0, 0], [1, 1, 1]), ([0, 0, 0], [1, 0, 0], [1, 1, 1]):
        mesh = cubes(*places)
        padding = hx.pad(mesh)
        check_layer(mesh, padding.mesh)
        assert padding.after.inverted == 0


def test_an_edge_at_which_the_mesh_crosses_itself_is_named():
    """Two cubes touch in an edge, and are connected by faces at both of its ends."""
    around = [[0, 0, 0], [1, 1, 0]]
    for z in (-1, 1):
        around += [[0, 0, z], [1, 0, z], [1, 1, z]]
    with pytest.raises(MeshError, match="at the edge between the nodes"):
        hx.pad(cubes(*around))


@pytest.mark.parametrize("seed", range(5))
def test_layers_of_random_blocks_are_conforming_or_refused(seed):
    random = np.random.default_rng(seed)
    whole = grid(3)
    kept = np.flatnonzero(random.random(27) < random.choice([0.3, 0.6, 0.9]))
    nodes, number = np.unique(whole.hexes[kept], return_inverse=True)
    mesh = Mesh(whole.points[nodes], number.reshape(-1, 8))
    region = random.random(mesh.n_hexes) < 0.5
    for sheet in (lambda: whole_sheet(mesh)), (lambda: around_sheet(mesh, np.flatnonzero(region), 0)):
        try:
            check_layer(mesh, padded_mesh(sheet()))
        except CrossingError as error:
            x = mesh.points[error.nodes]
            assert np.abs(x[1] - x[0]).sum() == 1  # an edge


def test_a_set_of_hexes_is_padded_next_to_other_cells():
    mesh = grid(2)
    apex = np.array([[1.0, 1.0, 3.0]])
    top = mesh.hexes[4][[4, 5, 6, 7]]
    pyramid = Cells("pyramid", np.array([[*top, mesh.n_nodes]]))
    mesh = Mesh(np.vstack([mesh.points, apex]), mesh.hexes, cells=(pyramid,), hex_sets={"all": np.arange(7)})
    with pytest.raises(MeshError, match="1 pyramid cells"):
        hx.pad(mesh)
    padding = hx.pad(mesh, "all")
    check_layer(mesh, padding.mesh)
    np.testing.assert_array_equal(padding.mesh.cells[0].nodes, pyramid.nodes)


def test_a_layer_around_hexes_grows_where_they_touch_in_an_edge():
    mesh = grid(3)
    marks = np.zeros((3, 3, 3), dtype=bool)  # z, y, x
    marks[:, 0, 0] = marks[:, 1, 1] = marks[0, 0, 1] = marks[2, 0, 1] = True
    sheet = around_sheet(mesh, np.flatnonzero(marks.ravel()), rings=0)
    assert np.count_nonzero(sheet.region) > np.count_nonzero(marks)
    check_layer(mesh, padded_mesh(sheet))


def test_a_layer_under_a_side_ends_on_the_sides_beside_it():
    mesh = grid(4)
    sets = {name: sides_where(mesh, lambda c, axis=axis: c[:, axis] == 0) for name, axis in (("x", 0), ("y", 1))}
    mesh = mesh.replace(side_sets=sets)
    for name in "x", "y":
        padding = hx.pad(mesh, name)
        check_layer(mesh, padding.mesh, boundary_kept=False)
        assert len(padding.layer) == 16
        assert padding.after.inverted == 0
        assert [area_of_sides(padding.mesh, one) for one in ("x", "y")] == pytest.approx([16, 16])
        assert hx.measure(padding.mesh.points, padding.mesh.hexes).scaled_jacobian.min() > 0.8


def test_a_set_of_hexes_gets_a_layer_on_all_sides():
    mesh = grid(4)
    inside = np.flatnonzero((np.abs(mesh.points[mesh.hexes].mean(axis=1) - 2) < 1).all(axis=1))
    corner = np.array([0])
    mesh = mesh.replace(hex_sets={"inside": inside, "corner": corner})
    for name, count in ("inside", 24), ("corner", 6):
        padding = hx.pad(mesh, name)
        check_layer(mesh, padding.mesh)
        assert len(padding.layer) == count
        assert padding.after.inverted == 0
        np.testing.assert_array_equal(padding.mesh.hex_sets[name], [*mesh.hex_sets[name], *padding.layer])


@pytest.mark.parametrize(("change", "name", "words"), [
    ({}, "nothing", "there is no set 'nothing'"),
    ({"node_sets": {"inner": np.array([62])}}, "inner", "has no face on the boundary"),
    ({"hex_sets": {"void": np.array([], np.int64)}}, "void", "the set 'void' has no hexes: expected one or more"),
    ({"side_sets": {"one": np.array([[5, 4]])}}, "one", "cannot be closed at 4 of the 4 edges"),
    ({"side_sets": {"flat": np.array([[0, 4]])}, "side_set_types": {"flat": "empty"}}, None, "two-dimensional"),
    ({"cells": (Cells("tetra", [[0, 1, 5, 30]]),)}, None, "1 tetra cells, and its boundary is theirs too"),
])  # fmt: skip
def test_a_layer_that_cannot_be_closed_is_an_error(change, name, words):
    with pytest.raises(MeshError, match=words):
        hx.pad(grid(4).replace(**change), name)


def test_a_layer_cannot_end_where_hexes_touch_in_an_edge_alone():
    mesh = cubes([0, 0, 0], [1, 1, 0])
    for sides in ([0, 4], [1, 4]), ([0, 4],):
        with pytest.raises(MeshError, match="touch there without a common face"):
            hx.pad(mesh.replace(side_sets={"bottom": np.array(sides)}), "bottom")


def test_choices_that_make_no_sense_are_errors():
    mesh = grid(2)
    for choices in {"thickness": -1}, {"thickness": float("nan")}, {"around": "bad"}, {"rings": -1}:
        with pytest.raises(ParameterError, match="expected"):
            hx.pad(mesh, **choices)
    with pytest.raises(ParameterError, match="choose one"):
        hx.pad(mesh, "x", around="locked")
    with pytest.raises(MeshError, match="no hex of the mesh is locked"):
        hx.pad(mesh, around="locked")
    with pytest.raises(MeshError, match="uses a node twice"):
        hx.pad(Mesh(mesh.points, np.vstack([mesh.hexes[:-1], mesh.hexes[-1:, [0, 1, 2, 2, 4, 5, 6, 7]]])))


@pytest.mark.slow
def test_nodes_at_which_the_boundary_leaves_no_space_are_named():
    mesh = grid(3)
    points = mesh.points.copy()
    top = np.flatnonzero((mesh.points == [1, 1, 3]).all(axis=1))[0]
    points[top] += [1.4, 1.4, 0]  # its quads fold over each other in the plane of the top
    mesh = mesh.with_points(points)
    padding = hx.pad(mesh)
    assert padding.after.inverted
    assert top in padding.nodes_without_space
    assert f"({', '.join(map(str, padding.nodes_without_space))}) the faces of the boundary" in padding.message


# The command `hexmend pad`.


@pytest.fixture
def block(tmp_path):
    path = tmp_path / "block.vtu"
    io.write(path, grid(3))
    return path


def test_pad_writes_the_mesh_and_a_report(block, tmp_path, run_command):
    out, report = tmp_path / "out.vtu", tmp_path / "report.json"
    printed = run_command("pad", block, "-o", out, "--json", report).out
    assert "The layer has 54 hexes" in printed
    values = json.loads(report.read_text())
    assert values["before"]["hexes"] == 27
    assert values["after"]["hexes"] == 81
    assert values["layer"]["first_hex"] == 27
    assert values["run"]["method"] == "mend"
    check_layer(io.read(block), io.read(out))


def test_pad_without_mending_says_what_is_inverted(tmp_path, run_command):
    mesh = grid(3)
    points = mesh.points.copy()
    points[0] = [0.9, 0.9, 0.9]
    path, out = tmp_path / "dent.vtu", tmp_path / "out.vtu"
    io.write(path, mesh.with_points(points))
    printed = run_command("pad", path, "-o", out, "--no-mend", "--thickness", "0.1", status=4).out
    assert "inverted. Mend the mesh." in printed
    np.testing.assert_array_equal(io.read(out).points[: mesh.n_nodes], points)


@pytest.mark.parametrize(("options", "status", "words"), [
    (["--set", "wall"], 3, "there is no set 'wall'"),
    (["--thickness", "0"], 2, "expected a positive length"),
    (["--around", "locked"], 3, "no hex of the mesh is locked"),
])  # fmt: skip
def test_errors_leave_no_file(block, tmp_path, run_command, options, status, words):
    out = tmp_path / "out.vtu"
    assert words in run_command("pad", block, "-o", out, *options, status=status).err
    assert not out.exists()
