"""Polyhedra of CGNS files (NGON_n, NFACE_n)."""

import h5py
import numpy as np
import pytest

from hexmend import FileError, io, summarise
from hexmend.io.base.polyhedra import LOOPS, faces_from_cells
from tests.core.grids import grid
from tests.core.io.formats.cgns.cgns_files import cgns, condition, section, unstructured


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


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (wrong_face, "section 'Cells' refers to faces that do not exist"),
        (wrong_node, "faces use the nodes 1 to 99: expected 1 to 8"),
    ],
)
def test_errors_name_the_problem(change, words, tmp_path):
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
