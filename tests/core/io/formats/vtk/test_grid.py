"""Every kind of cell of VTK's, by the nodes that VTK itself gives it, through both of its formats."""

import numpy as np
import pytest

from hexmend import io
from hexmend.mesh.cells import CELL_KINDS
from hexmend.mesh.hexahedron import CORNER_TETRAHEDRA, UNIT_CUBE
from hexmend.mesh.second_order import MID_NODE_POSITIONS
from tests.core.io.formats.vtk.test_vtu import WRITERS
from tests.core.io.vtk_writers import by_vtk

vtk = pytest.importorskip("vtk")
pyvista = pytest.importorskip("pyvista")
SUFFIXES = pytest.mark.parametrize("suffix", [".vtu", ".vtk"])
#: Kinds of cells and the class of VTK's that knows where their nodes lie.
CLASSES = {
    12: "Hexahedron", 11: "Voxel", 25: "QuadraticHexahedron", 29: "TriQuadraticHexahedron", 10: "Tetra", 13: "Wedge",
    14: "Pyramid", 9: "Quad", 8: "Pixel", 5: "Triangle", 3: "Line", 1: "Vertex", 21: "QuadraticEdge",
    22: "QuadraticTriangle", 23: "QuadraticQuad", 28: "BiQuadraticQuad", 24: "QuadraticTetra", 26: "QuadraticWedge",
    27: "QuadraticPyramid",
}  # fmt: skip


def places(number):
    """Where VTK says that a cell's nodes lie in the reference cell."""
    cell = getattr(vtk, f"vtk{CLASSES[number]}")()
    if number == 1:
        return np.zeros((1, 3))
    coordinates = cell.GetParametricCoords()
    return np.reshape([coordinates[k] for k in range(3 * cell.GetNumberOfPoints())], (-1, 3))


def written(path, numbers, shift=3.0):
    """Cells of these types in a row, each with nodes of its own, written by VTK; their places."""
    parts = [places(number) + [shift * k, 0, 0] for k, number in enumerate(numbers)]
    first = np.cumsum([0, *map(len, parts)])
    cells = np.concatenate(
        [[len(part), *range(start, start + len(part))] for start, part in zip(first[:-1], parts, strict=True)]
    )
    content = pyvista.UnstructuredGrid(cells, np.array(numbers, np.uint8), np.concatenate(parts))
    content.cell_data["cell"] = np.arange(len(numbers))
    content.point_data["node"] = np.arange(first[-1])
    by_vtk(WRITERS[path.suffix](), path, content)
    return parts


@SUFFIXES
def test_every_kind_is_read_in_vtks_order(suffix, tmp_path):
    numbers = [10, 12, 9, 25, 11, 8, 29, 14, 13, 5, 3, 1, 21, 22, 23, 28, 24, 26, 27, 12, 25]
    parts = written(tmp_path / f"a{suffix}", numbers)
    mesh = io.read(tmp_path / f"a{suffix}", as_is=True)
    np.testing.assert_array_equal(mesh.points, np.concatenate(parts))
    corners = mesh.points[mesh.hexes]
    which = mesh.hex_data["cell"]
    assert sorted(which) == [k for k, number in enumerate(numbers) if number in (11, 12, 25, 29)]
    np.testing.assert_array_equal(corners, UNIT_CUBE + np.outer(3 * which, [1, 0, 0])[:, None])
    for row, k in zip(mesh.mid_nodes, which, strict=True):
        found = mesh.points[row[row >= 0]]
        np.testing.assert_array_equal(found, MID_NODE_POSITIONS[: {25: 12, 29: 19}.get(numbers[k], 0)] + [3 * k, 0, 0])
    by_cell = {
        int(k): (cells.kind, nodes)
        for cells in mesh.cells
        for k, nodes in zip(cells.data["cell"], cells.nodes, strict=True)
    }
    for k, number in enumerate(numbers):
        if number not in (11, 12, 25, 29):
            kind, nodes = by_cell[k]
            assert CELL_KINDS[kind].vtk == {8: 9}.get(number, number)
            expected = parts[k][[0, 1, 3, 2]] if number == 8 else parts[k]
            np.testing.assert_array_equal(mesh.points[nodes], expected)
    assert mesh.pinned is None
    assert mesh.n_elements == mesh.n_hexes + sum(number in (10, 13, 14, 24, 26, 27) for number in numbers)


@SUFFIXES
@pytest.mark.parametrize("encoding", ["binary", "ascii"])
def test_every_kind_is_written_as_vtk_has_it(suffix, encoding, tmp_path):
    numbers = [12, 25, 29, 10, 13, 14, 9, 5, 3, 1, 21, 22, 23, 28, 24, 26, 27]
    written(tmp_path / "a.vtu", numbers)
    mesh = io.read(tmp_path / "a.vtu", as_is=True)
    io.write(tmp_path / f"b{suffix}", mesh, encoding=encoding)
    found = pyvista.read(tmp_path / f"b{suffix}")
    for k, which in enumerate(found.cell_data["cell"]):
        assert found.celltypes[k] == numbers[which]
        np.testing.assert_array_equal(found.get_cell(k).points, places(numbers[which]) + [3 * which, 0, 0])
    back = io.read(tmp_path / f"b{suffix}", as_is=True)
    np.testing.assert_array_equal(back.mid_nodes, mesh.mid_nodes)
    np.testing.assert_array_equal(back.hexes, mesh.hexes)


@SUFFIXES
def test_polyhedra_and_lagranges_hexahedra_are_left_out_and_that_is_said(suffix, tmp_path):
    cells = np.array([8, *range(8), 27, *(k % 8 for k in range(27)), 8, *range(8)])
    content = pyvista.UnstructuredGrid(cells, np.array([12, 72, 72], np.uint8), UNIT_CUBE)
    if suffix == ".vtu":
        faces = vtk.vtkIdList()
        for value in (4, 4, 0, 1, 2, 3, 3, 0, 1, 4, 3, 1, 2, 4, 4, 2, 3, 0, 4):
            faces.InsertNextId(value)
        content.InsertNextCell(42, faces)
    by_vtk(WRITERS[suffix](), tmp_path / f"a{suffix}", content)
    mesh = io.read(tmp_path / f"a{suffix}")
    assert mesh.n_hexes == 2  # one of Lagrange's is of order 1
    assert any("VTK_LAGRANGE_HEXAHEDRON" in note and "Not read" in note for note in mesh.notes)
    assert any("VTK_POLYHEDRON" in note for note in mesh.notes) is (suffix == ".vtu")


def relabelled(path, numbers, types):
    """The cells with other types, which VTK itself would not write."""
    written(path, numbers)
    mesh = io.read(path)
    io.write(path, mesh, encoding="ascii")
    text = path.read_text()
    if path.suffix == ".vtu":
        before, after = text.split('Name="types"')
        head, rest = after.split(">\n", 1)
        text = f'{before}Name="types"{head}>\n' + "\n".join(map(str, types)) + rest[rest.index("\n</") :]
    else:
        before, after = text.split("CELL_TYPES 2\n")
        text = before + "CELL_TYPES 2\n" + "\n".join(map(str, types)) + "\n" + after.split("\n", 2)[2]
    path.write_text(text)


@SUFFIXES
def test_hexes_labelled_as_tetrahedra_are_read_where_all_have_eight_nodes(suffix, tmp_path):
    path = tmp_path / f"a{suffix}"
    relabelled(path, [12, 12], [10, 10])
    mesh = io.read(path)
    assert mesh.n_hexes == 2
    assert "2 cells of eight nodes are labelled as tetrahedra in the file: read as hexes." in mesh.notes
    corners = mesh.points[mesh.hexes[0]]
    a, b, c, d = corners[CORNER_TETRAHEDRA[0]]
    assert np.linalg.det([b - a, c - a, d - a]) > 0


HEX_FACES = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]
WEDGE_FACES = [[0, 1, 2], [3, 5, 4], [0, 3, 4, 1], [1, 4, 5, 2], [2, 5, 3, 0]]


@pytest.mark.parametrize(("suffix", "version"), [(".vtu", ""), (".vtu", "1.0"), (".vtk", "5.1"), (".vtk", "4.2")])
def test_polyhedra_that_are_hexes_and_wedges_are_read_as_such(suffix, version, tmp_path):
    points, streams = [*UNIT_CUBE, *(places(13) + [3, 0, 0])], []
    for faces, first in ((HEX_FACES, 0), (WEDGE_FACES, 8)):
        streams.append([len(faces), *(number for face in faces for number in (len(face), *(first + k for k in face)))])
    grid = pyvista.UnstructuredGrid(np.concatenate([[len(row), *row] for row in streams]), [42, 42], np.array(points))
    path = tmp_path / f"a{suffix}"
    writer = vtk.vtkXMLUnstructuredGridWriter() if suffix == ".vtu" else vtk.vtkUnstructuredGridWriter()
    writer.SetFileName(str(path))
    writer.SetInputData(grid)
    if suffix == ".vtk":
        writer.SetFileVersion(int(version.replace(".", "")))
    else:
        writer.SetDataModeToAscii()
    writer.Write()
    if version == "1.0":  # as VTK wrote it before 9.4
        head, tail = path.read_text().split('<DataArray type="Int64" Name="face_connectivity"')
        arrays = {"faces": np.concatenate(streams).tolist(), "faceoffsets": np.cumsum([*map(len, streams)]).tolist()}
        form = '<DataArray type="Int64" Name="{}" format="ascii">{}</DataArray>'.format
        texts = (form(name, " ".join(map(str, numbers))) for name, numbers in arrays.items())
        path.write_text(head + "".join(texts) + tail[tail.index("</Cells>") :])
    mesh = io.read(path)
    np.testing.assert_allclose(sorted(mesh.points[mesh.hexes[0]].tolist()), sorted(UNIT_CUBE.tolist()))
    assert np.linalg.det((mesh.points[mesh.hexes[0]] - mesh.points[mesh.hexes[0, 0]])[[1, 3, 4]]) == pytest.approx(1)
    assert [(cells.kind, sorted(cells.nodes[0])) for cells in mesh.cells] == [("wedge", list(range(8, 14)))]
