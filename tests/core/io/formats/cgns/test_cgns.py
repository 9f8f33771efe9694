"""CGNS: structured and unstructured zones, their interfaces and boundary conditions."""

import h5py
import numpy as np
import pytest

from hexmend import FileError, io, summarise
from hexmend.io.base.polyhedra import LOOPS, faces_from_cells
from hexmend.mesh.hexahedron import FACES, UNIT_CUBE
from hexmend.mesh.second_order import MID_NODE_POSITIONS
from tests.core.grids import grid
from tests.core.io.formats.cgns.cgns_files import cgns, condition, section, structured, unstructured

#: Twice the coordinates of a HEXA_27's nodes in the unit cube, from the standard's figure, from node 1.
HEXA_27 = np.array(
    [
        [0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0], [0, 0, 2], [2, 0, 2], [2, 2, 2], [0, 2, 2],
        [1, 0, 0], [2, 1, 0], [1, 2, 0], [0, 1, 0], [0, 0, 1], [2, 0, 1], [2, 2, 1], [0, 2, 1],
        [1, 0, 2], [2, 1, 2], [1, 2, 2], [0, 1, 2], [1, 1, 0], [1, 0, 1], [2, 1, 1], [1, 2, 1],
        [0, 1, 1], [1, 1, 2], [1, 1, 1],
    ]
)  # fmt: skip
#: Nodes of a hex's faces 1 to 6, from the standard.
FACES_OF_HEX = [[1, 4, 3, 2], [1, 2, 6, 5], [2, 3, 7, 6], [3, 4, 8, 7], [1, 5, 8, 4], [5, 6, 7, 8]]


def lattice(ni, nj, nk, shift=(0.0, 0.0, 0.0)):
    return np.stack(np.meshgrid(np.arange(ni), np.arange(nj), np.arange(nk), indexing="ij"), axis=-1) + np.array(shift)


def faces_of(mesh, name):
    """Points of the faces of a side set, sorted within each face."""
    rows = mesh.side_sets[name]
    return mesh.points[mesh.hexes[rows[:, :1], FACES[rows[:, 1]]]]


@pytest.mark.parametrize(("kind", "width"), [(17, 8), (18, 20), (19, 27)])
def test_nodes_of_every_order_have_vtks_order(kind, width, tmp_path):
    with cgns(tmp_path / "one.cgns") as base:
        section(unstructured(base, "z", HEXA_27[:width] / 2, 1), "hexes", kind, 1, 1, range(1, width + 1))
    mesh = io.read(tmp_path / "one.cgns")
    np.testing.assert_array_equal(mesh.points[mesh.hexes[0]], UNIT_CUBE)
    if width > 8:
        np.testing.assert_array_equal(mesh.points[mesh.mid_nodes[0, : width - 8]], MID_NODE_POSITIONS[: width - 8])
    of_vtk = points_of_vtk(tmp_path / "one.cgns")
    np.testing.assert_array_equal(of_vtk[0], np.concatenate([UNIT_CUBE, MID_NODE_POSITIONS])[:width])


def points_of_vtk(path):
    """Points of each cell, read by VTK."""
    vtk = pytest.importorskip("vtk")
    from vtk.util.numpy_support import vtk_to_numpy

    reader = vtk.vtkCGNSReader()
    reader.SetFileName(str(path))
    reader.Update()
    blocks, answer = reader.GetOutput().GetBlock(0), []
    for k in range(blocks.GetNumberOfBlocks()):
        zone = blocks.GetBlock(k)
        points = vtk_to_numpy(zone.GetPoints().GetData())
        for cell in range(zone.GetNumberOfCells()):
            ids = zone.GetCell(cell).GetPointIds()
            answer.append(points[[ids.GetId(i) for i in range(ids.GetNumberOfIds())]])
    return answer


def test_parent_elements_give_side_sets(tmp_path):
    with cgns(tmp_path / "p.cgns") as base:
        zone = unstructured(base, "z", UNIT_CUBE, 1)
        section(zone, "hexes", 17, 1, 1, range(1, 9))
        for face, nodes in enumerate(FACES_OF_HEX, 1):
            one = section(zone, f"face {face}", 7, face + 1, face + 1, nodes if face % 2 else np.zeros(4))
            one.add("ParentElements", "DataArray_t", np.array([[1, 0]], np.int32))
            one.add("ParentElementsPosition", "DataArray_t", np.array([[face, 0]], np.int32))
    mesh = io.read(tmp_path / "p.cgns")
    for face, nodes in enumerate(FACES_OF_HEX, 1):
        ((hex_, side),) = mesh.side_sets[f"face {face}"]
        assert set(mesh.hexes[hex_, FACES[side]] + 1) == set(nodes)
    assert sum(len(cells.nodes) for cells in mesh.cells) == 3  # those faces whose nodes are given


@pytest.mark.parametrize("offsets", [False, True])
def test_a_mixed_section_is_split_by_kind(offsets, tmp_path):
    bare = grid(1)
    points = np.vstack([bare.points, [[0.5, 0.5, 2], [0.5, 0.5, -1]]])
    rows = [[17, *(bare.hexes[0] + 1)], [12, *(bare.hexes[0, 4:] + 1), 9], [7, *(bare.hexes[0, [0, 3, 2, 1]] + 1)]]
    with cgns(tmp_path / "m.cgns") as base:
        zone = unstructured(base, "z", points, 2)
        one = section(zone, "all", 20, 1, 3, np.concatenate(rows))
        if offsets:
            starts = np.cumsum([0, *(len(row) for row in rows)])
            one.add("ElementStartOffset", "DataArray_t", starts.astype(np.int32))
        condition(zone, "floor", "PointRange", [[3, 3]], "FaceCenter")
        solution = zone.add("at cells", "FlowSolution_t")
        solution.add("GridLocation", "GridLocation_t", "CellCenter")
        solution.add("p", "DataArray_t", np.array([4.0, 5.0]))
    mesh = io.read(tmp_path / "m.cgns")
    np.testing.assert_array_equal(mesh.hexes, bare.hexes)
    pyramid, quad = mesh.cells
    assert (pyramid.kind, quad.kind) == ("pyramid", "quad")
    assert quad.sets["floor"].tolist() == [0]
    assert (mesh.hex_data["p"].tolist(), pyramid.data["p"].tolist()) == ([4], [5])
    assert [mesh.pinned, mesh.n_elements] == [None, 2]


def test_a_structured_zone_is_read_with_its_faces_and_results(tmp_path):
    with cgns(tmp_path / "s.cgns") as base:
        zone = structured(base, "block", lattice(3, 4, 5).astype(float))
        condition(zone, "in", "PointRange", [[1, 1], [1, 4], [1, 5]])
        condition(zone, "top", "PointRange", [[1, 2], [1, 3], [5, 5]], "KFaceCenter")
        condition(zone, "edge", "PointRange", [[1, 1], [1, 1], [1, 5]])
        condition(zone, "patch", "PointRange", [[3, 3], [2, 3], [1, 2]], family="outlet")
        solution = zone.add("flow", "FlowSolution_t")
        solution.add("GridLocation", "GridLocation_t", "CellCenter")
        solution.add("Rind", "Rind_t", np.array([1, 0, 0, 0, 0, 2], np.int32))
        values = np.full((3, 3, 6), np.nan)
        values[1:, :, :4] = lattice(2, 3, 4) @ [1.0, 10.0, 100.0]
        solution.add("p", "DataArray_t", values)
    mesh = io.read(tmp_path / "s.cgns")
    assert mesh.n_hexes == 24
    assert summarise(mesh).q_min == pytest.approx(1)
    low = mesh.points[mesh.hexes].min(axis=1)
    np.testing.assert_array_equal(mesh.hex_data["p"], low @ [1.0, 10.0, 100.0])
    assert {name: len(rows) for name, rows in mesh.side_sets.items()} == {"in": 12, "top": 6, "outlet": 1}
    assert (faces_of(mesh, "in")[..., 0] == 0).all()
    assert (faces_of(mesh, "top")[..., 2] == 4).all()
    np.testing.assert_array_equal(faces_of(mesh, "outlet")[0].mean(axis=0), [2, 1.5, 0.5])
    assert mesh.points[mesh.node_sets["edge"]][:, :2].max() == 0
    assert len(points_of_vtk(tmp_path / "s.cgns")) == 24


def test_a_left_handed_zone_is_reoriented(tmp_path):
    with cgns(tmp_path / "l.cgns") as base:
        zone = structured(base, "left", lattice(3, 3, 3)[:, :, ::-1].astype(float))
        condition(zone, "first k", "PointRange", [[1, 3], [1, 3], [1, 1]])
    mesh = io.read(tmp_path / "l.cgns")
    assert summarise(mesh).inverted == 0
    assert (faces_of(mesh, "first k")[..., 2] == 2).all()


def test_structured_zones_are_merged_at_their_interfaces(tmp_path):
    """The second zone's i runs along -y, its j along z and its k along x."""
    second = lattice(3, 4, 5, (2, 0, 0)).astype(float).transpose(1, 2, 0, 3)[::-1]
    with cgns(tmp_path / "j.cgns") as base:
        one, other = structured(base, "one", lattice(3, 4, 5).astype(float)), structured(base, "two", second)
        for zone, name, donor, own, its, turn in (
            (one, "to two", "two", [[3, 3], [1, 4], [1, 5]], [[4, 1], [1, 5], [1, 1]], [3, -1, 2]),
            (other, "to one", "one", [[1, 4], [1, 5], [1, 1]], [[3, 3], [4, 1], [1, 5]], [-2, 3, 1]),
        ):
            where = zone.add("ZoneGridConnectivity", "ZoneGridConnectivity_t")
            join = where.add(name, "GridConnectivity1to1_t", donor)
            join.add("PointRange", "IndexRange_t", np.array(own, np.int32))
            join.add("PointRangeDonor", "IndexRange_t", np.array(its, np.int32))
            join.add("Transform", '"int[IndexDimension]"', np.array(turn, np.int32))
        condition(other, "end", "PointRange", [[1, 4], [1, 5], [3, 3]])
    mesh = io.read(tmp_path / "j.cgns")
    assert (mesh.n_hexes, mesh.n_nodes) == (48, 5 * 4 * 5)
    assert len(np.unique(mesh.points, axis=0)) == mesh.n_nodes
    assert summarise(mesh).inverted == 0
    assert {name: len(members) for name, members in mesh.hex_sets.items()} == {"one": 24, "two": 24}
    assert (faces_of(mesh, "end")[..., 0] == 4).all()
    assert "joined at 20 nodes" in " ".join(mesh.notes)


def test_periodic_interfaces_merge_no_nodes(tmp_path):
    with cgns(tmp_path / "p.cgns") as base:
        zone = structured(base, "ring", lattice(3, 3, 3).astype(float))
        join = zone.add("ZoneGridConnectivity", "ZoneGridConnectivity_t").add("own", "GridConnectivity1to1_t", "ring")
        join.add("PointRange", "IndexRange_t", np.array([[1, 1], [1, 3], [1, 3]], np.int32))
        join.add("PointRangeDonor", "IndexRange_t", np.array([[3, 3], [1, 3], [1, 3]], np.int32))
        join.add("Transform", '"int[IndexDimension]"', np.array([1, 2, 3], np.int32))
    assert io.read(tmp_path / "p.cgns").n_nodes == 27


def test_unstructured_zones_are_merged_by_lists_of_nodes(tmp_path):
    with cgns(tmp_path / "u.cgns") as base:
        for name, shift in (("a", 0.0), ("b", 1.0)):
            zone = unstructured(base, name, UNIT_CUBE + [shift, 0, 0], 1)
            section(zone, "hexes", 17, 1, 1, range(1, 9))
            zone.add("FamilyName", "FamilyName_t", f"material {name}")
            condition(zone, "far", "PointList", [[2, 3]])
            if name == "a":
                join = zone.add("ZoneGridConnectivity", "ZoneGridConnectivity_t").add("j", "GridConnectivity_t", "b")
                join.add("GridConnectivityType", "GridConnectivityType_t", "Abutting1to1")
                join.add("PointList", "IndexArray_t", np.array([[2, 3, 6, 7]], np.int32))
                join.add("PointListDonor", "IndexArray_t", np.array([[1, 4, 5, 8]], np.int32))
    mesh = io.read(tmp_path / "u.cgns")
    assert (mesh.n_hexes, mesh.n_nodes) == (2, 12)
    assert {name: list(members) for name, members in mesh.hex_sets.items()} == {"material a": [0], "material b": [1]}
    np.testing.assert_array_equal(np.sort(mesh.points[mesh.node_sets["far"]][:, 0]), [1, 1, 2, 2])


def test_a_real_file_has_its_faces_on_the_boundary(real_mesh):
    mesh = io.read(real_mesh("BC_Q2_parents.cgns"))
    assert mesh.n_hexes == 3840
    assert (mesh.mid_nodes >= 0).all()
    outside = {tuple(row) for row in np.sort(mesh.topology.boundary_faces, axis=1).tolist()}
    named = np.concatenate([mesh.hexes[rows[:, :1], FACES[rows[:, 1]]] for rows in mesh.side_sets.values()])
    assert {tuple(row) for row in np.sort(named, axis=1).tolist()} == outside


ERRORS = [
    ("sizes", "has the sizes"),
    ("coordinates", "expected numbers"),
    ("huge", r"holds float64 \(8,\): expected numbers \(2147483647,\)"),
    ("nodes", "uses the nodes 1 to 99: expected 1 to 8"),
    ("count", "has 7 elements of 8 nodes, and 8 nodes"),
    ("polar", "Write it with Cartesian coordinates"),
    ("surface", "no zone of three dimensions"),
]


@pytest.mark.parametrize(("how", "words"), ERRORS)
def test_errors_name_the_problem(how, words, tmp_path):
    with cgns(tmp_path / "bad.cgns", (2, 3) if how == "surface" else (3, 3)) as base:
        zone = unstructured(base, "z", UNIT_CUBE[: 4 if how == "coordinates" else 8], 1)
        nodes = [1, 2, 3, 4, 5, 6, 7, 99 if how == "nodes" else 8]
        section(zone, "hexes", 17, 1, 7 if how == "count" else 1, nodes)
        data = zone.group[" data"]
        if how == "coordinates":
            data[0] = 8
        elif how in ("sizes", "huge"):
            data[0, 0] = -8 if how == "sizes" else 2**31 - 1
        elif how == "polar":
            zone.group["GridCoordinates"].move("CoordinateX", "CoordinateR")
    with pytest.raises(FileError, match=words):
        io.read(tmp_path / "bad.cgns")


# Polyhedra of CGNS files (NGON_n, NFACE_n).


def written(path, points, blocks, offsets=True, change=lambda faces, cells: None):
    """Write a file of polyhedra, with a solution and a boundary condition."""
    loops, halves = faces_from_cells(blocks)
    faces = [(row[row >= 0] + 1).tolist() for row in loops]
    signed = np.where(halves.values & 1, 1, -1) * (
        (halves.values >> 1) + 1
    )  # seen from inside, the normal of a face points into the cell
    cells = [part.tolist() for part in np.split(signed, halves.start[1:-1])]
    bottom = [k + 1 for k, face in enumerate(faces) if (points[np.array(face) - 1, 2] == 0).all()]
    change(faces, cells)
    with cgns(path) as base:
        zone = unstructured(base, "Zone", points, len(cells))
        first = 1
        for name, kind, rows in (("Faces", 22, faces), ("Cells", 23, cells)):
            flat = [number for row in rows for number in (row if offsets else [len(row), *row])]
            one = section(zone, name, kind, first, first + len(rows) - 1, flat)
            if offsets:
                one.add("ElementStartOffset", "DataArray_t", np.cumsum([0, *map(len, rows)]))
            first += len(rows)
        values = zone.add("Solution", "FlowSolution_t")
        values.add("GridLocation", "GridLocation_t", "CellCenter")
        values.add("Pressure", "DataArray_t", np.arange(len(cells)) / 2)
        condition(zone, "bottom", "PointList", [bottom], "FaceCenter")
    return path


@pytest.mark.parametrize("offsets", [True, False])
def test_polyhedra_of_six_quads_are_hexes(offsets, tmp_path):
    mesh = grid(3, 2, 2)
    back = io.read(written(tmp_path / "a.cgns", mesh.points, [("hex", mesh.hexes)], offsets), as_is=True)
    np.testing.assert_array_equal(np.sort(back.hexes, axis=1), np.sort(mesh.hexes, axis=1))
    assert summarise(back).q_min == pytest.approx(1)
    np.testing.assert_array_equal(back.hex_data["Pressure"], np.arange(12) / 2)
    (quads,) = back.cells
    assert len(quads.nodes) == len(mesh.topology.boundary_faces)
    assert (mesh.points[quads.nodes[quads.sets["bottom"]]][..., 2] == 0).all()
    assert len(quads.sets["bottom"]) == 6
    assert back.notes == ()


def test_other_kinds_are_kept_too(tmp_path):
    points = np.vstack([grid(1).points, [[0.5, 0.5, 2], [0.5, 0.5, 3], [2, 0, 0], [2, 0, 1]]])
    corners = grid(1).hexes[0]
    kinds = {
        "wedge": [[corners[1], 10, corners[2], corners[5], 11, corners[6]]],
        "pyramid": [[*corners[4:], 8]],
        "tetra": [[corners[5], corners[6], 8, 9]],
    }
    blocks = [("hex", corners[None]), *((kind, np.array(rows)) for kind, rows in kinds.items())]
    back = io.read(written(tmp_path / "a.cgns", points, blocks))
    assert {one.kind: one.nodes.tolist() for one in back.cells if one.kind in LOOPS} == {
        kind: np.array(rows).tolist() for kind, rows in kinds.items()
    }


def without_a_face(faces, cells):
    cells[0].pop()


def test_polyhedra_of_other_kinds_are_left_out_with_a_note(tmp_path):
    mesh = grid(2)
    back = io.read(written(tmp_path / "a.cgns", mesh.points, [("hex", mesh.hexes)], change=without_a_face))
    assert back.n_hexes == 7
    assert back.notes == (
        "Left out: 1 polyhedron of section 'Cells'.",
        "Cell data are left out because some cells are.",
    )


def wrong_face(faces, cells):
    cells[0][0] = 99


def wrong_node(faces, cells):
    faces[0][0] = 99


ERRORS_IN_POLYHEDRA = [
    (wrong_face, "section 'Cells' refers to faces that do not exist"),
    (wrong_node, "faces use the nodes 1 to 99: expected 1 to 8"),
]


@pytest.mark.parametrize(("change", "words"), ERRORS_IN_POLYHEDRA)
def test_errors_in_polyhedra_are_named(change, words, tmp_path):
    mesh = grid(1)
    with pytest.raises(FileError, match=words):
        io.read(written(tmp_path / "a.cgns", mesh.points, [("hex", mesh.hexes)], change=change))


@pytest.mark.parametrize("offsets", [[0, 4, 8, 12, 16, 20], [0, 4, 8, 12, 16, 20, 25], [0, 4, 3, 12, 16, 20, 24]])
def test_inconsistent_rows_are_reported(offsets, tmp_path):
    path = written(tmp_path / "a.cgns", grid(1).points, [("hex", grid(1).hexes)])
    with h5py.File(path, "a") as file:
        data = file["Base/Zone/Faces/ElementStartOffset"]
        del data[" data"]
        data[" data"] = offsets
    with pytest.raises(FileError, match="section 'Faces' does not have 6 rows"):
        io.read(path)


def test_polygons_left_out_are_noted(tmp_path):
    mesh = grid(2)

    def with_more(faces, cells):
        """A face that nothing uses, and a quad of the boundary with a fifth node."""
        outer = next(k for k in range(len(faces)) if sum(abs(face) == k + 1 for cell in cells for face in cell) == 1)
        faces[outer] = [*faces[outer], faces[outer][0]]
        faces.append(faces[0][:3])

    back = io.read(written(tmp_path / "a.cgns", mesh.points, [("hex", mesh.hexes)], change=with_more))
    assert back.n_hexes == 7
    assert sum("2 polygons of section 'Faces'" in note for note in back.notes) == 1
