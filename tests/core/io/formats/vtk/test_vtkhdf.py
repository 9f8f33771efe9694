"""VTKHDF as VTK's own writer makes it, and what is wrong with others."""

import numpy as np
import pytest

from hexmend import io
from hexmend.errors import FileError
from tests.core.grids import grid, scrambled

h5py = pytest.importorskip("h5py")


def written_by_vtk(path, mesh, parts=1, compression=0):
    vtk = pytest.importorskip("vtk")
    pyvista = pytest.importorskip("pyvista")
    content = pyvista.UnstructuredGrid({12: mesh.hexes.astype(np.int64)}, mesh.points)
    content.point_data["velocity"] = mesh.points + 1
    content.cell_data["material"] = np.arange(mesh.n_hexes, dtype=np.int16)
    content.field_data["time"] = np.array([0.25, 0.5])
    whole = content
    if parts > 1:
        whole = vtk.vtkPartitionedDataSet()
        for k in range(parts):
            piece = content.extract_cells(range(k, mesh.n_hexes, parts))
            for name in [name for name in piece.array_names if name.startswith("vtkOriginal")]:
                (piece.point_data if name in piece.point_data else piece.cell_data).remove(name)
            whole.SetPartition(k, piece)
    writer = vtk.vtkHDFWriter()
    writer.SetInputData(whole)
    writer.SetFileName(str(path))
    writer.SetCompressionLevel(compression)
    assert writer.Write()


@pytest.mark.parametrize("compression", [0, 4])
def test_what_vtk_writes_is_read(compression, tmp_path):
    mesh = scrambled(grid(3), 0.3)
    written_by_vtk(tmp_path / "a.vtkhdf", mesh, compression=compression)
    back = io.read(tmp_path / "a.vtkhdf")
    np.testing.assert_array_equal(back.points, mesh.points)
    np.testing.assert_array_equal(back.hexes, mesh.hexes)
    np.testing.assert_array_equal(back.node_data["velocity"], mesh.points + 1)
    np.testing.assert_array_equal(back.hex_data["material"], np.arange(27))
    np.testing.assert_array_equal(np.ravel(back.field_data["time"]), [0.25, 0.5])


def test_every_name_and_type_comes_back(tmp_path):
    arrays = {code: np.arange(27).astype(code) for code in ("i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8", "f4", "f8")}
    arrays |= {
        "true": np.arange(27) > 5,
        "rows": np.arange(54.0).reshape(27, 2),
        "ä λ": np.arange(27),
        "a/b": np.ones(27),
    }
    fields = {"title": ["made & elsewhere", "ä"], "time": np.array([0.1]), "line": "one"}
    sets = {"some": np.array([1, 5])}
    mesh = scrambled(grid(3), 0.3)
    mesh = mesh.replace(hex_data=arrays, field_data=fields, hex_sets=sets, pinned=np.arange(mesh.n_nodes) == 30)
    path = tmp_path / "a.vtkhdf"
    io.write(path, mesh)
    back = io.read(path)
    np.testing.assert_array_equal(back.points, mesh.points)
    np.testing.assert_array_equal(back.hexes, mesh.hexes)
    np.testing.assert_array_equal(back.pinned, mesh.pinned)
    np.testing.assert_array_equal(back.hex_sets["some"], sets["some"])
    for name, values in arrays.items():
        found = back.hex_data[name.replace("/", "_")]
        np.testing.assert_array_equal(found, values)
        assert found.dtype == (np.uint8 if name == "true" else values.dtype)
    np.testing.assert_array_equal(back.field_data["time"], fields["time"])
    assert back.field_data["title"] == fields["title"]
    assert back.field_data["line"] == ["one"]
    assert io.unsupported_data(path, mesh) == ["names of data and sets as they are (a/b)"]
    again = tmp_path / "b.vtkhdf"
    io.write(again, back)
    np.testing.assert_array_equal(io.read(again).hex_data["rows"], arrays["rows"])


def test_vtk_reads_what_is_written(tmp_path):
    pyvista = pytest.importorskip("pyvista")
    data = {"a": np.arange(64.0), "tensors": np.arange(576.0).reshape(64, 3, 3), "none": np.zeros((64, 0))}
    fields = {"title": ["x", "ä"], "no texts": [], "empty": np.zeros(0), "deep": np.ones((2, 3, 3))}
    mesh = scrambled(grid(3), 0.3).replace(node_data=data, field_data=fields)
    io.write(tmp_path / "a.vtkhdf", mesh)
    other = pyvista.read(tmp_path / "a.vtkhdf")
    np.testing.assert_array_equal(other.points, mesh.points)
    np.testing.assert_array_equal(other.cells_dict[12], mesh.hexes)
    np.testing.assert_array_equal(other.point_data["a"], np.arange(64.0))
    np.testing.assert_array_equal(other.point_data["tensors"].reshape(64, 3, 3), data["tensors"])
    assert list(other.field_data["title"]) == fields["title"]


def test_what_vtk_cannot_hold_is_refused(tmp_path):
    for fields in ({"z": np.zeros(8, np.complex128)}, {"z": np.zeros(8, np.longdouble)}, {"z": {"a": 1}}):
        with pytest.raises(FileError, match="which VTK cannot"):
            io.write(tmp_path / "a.vtkhdf", grid(1).replace(field_data=fields))
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("offsets", [np.array([0, 200, 8], np.uint8), np.array([0, 2 * 10**9, 8], np.int32)])
def test_offsets_that_fall_are_found_whatever_their_type(offsets, tmp_path):
    def falling(root):
        for name in ("Offsets", "NumberOfCells", "Types"):
            del root[name]
        root["Offsets"], root["NumberOfCells"], root["Types"] = offsets, [2], np.array([12, 12], np.uint8)

    with pytest.raises(FileError, match="do not rise"):
        io.read(hand_made(tmp_path / "a.vtkhdf", falling, parts=1))


def hand_made(path, change=None, parts=2):
    """Two parts of a hex each, as the manual has them, and strings."""
    mesh = grid(1)
    with h5py.File(path, "w") as file:
        root = file.create_group("VTKHDF")
        root.attrs["Version"] = (2, 2)
        root.attrs["Type"] = np.bytes_("UnstructuredGrid")
        for name, count in (("Points", 8), ("Cells", 1), ("ConnectivityIds", 8)):
            root[f"NumberOf{name}"] = np.full(parts, count)
        root["Points"] = np.concatenate([mesh.points + [k, 0, 0] for k in range(parts)]).astype(">f4")
        root["Connectivity"] = np.tile(mesh.hexes[0], parts)
        root["Offsets"] = np.tile([0, 8], parts)
        root["Types"] = np.full(parts, 12, np.uint8)
        root["PointData/GlobalNodeIds"] = np.array([0, 1, 2, 3, 4, 5, 6, 7, 1, 8, 9, 2 + 1, 5, 10, 11, 7])[: 8 * parts]
        root["CellData/vtkGhostType"] = np.arange(parts, dtype=np.uint8)
        root["FieldData/title"] = ["made", "elsewhere"]
        if change is not None:
            change(root)
    return path


def test_parts_are_put_together_without_ghosts(tmp_path):
    back = io.read(hand_made(tmp_path / "a.vtkhdf"))
    assert back.n_hexes == 1
    assert back.n_nodes == 8
    assert back.field_data["title"] == ["made", "elsewhere"]
    assert "1 ghost cells" in back.notes[-1]

    def plain(root):
        del root["CellData"]
        del root["PointData"]

    back = io.read(hand_made(tmp_path / "a.vtkhdf", plain))
    assert back.n_hexes == 2
    assert (back.hexes[1] == grid(1).hexes[0] + 8).all()
    assert "4 duplicate nodes remain where they meet" in back.notes[0]


def test_the_first_of_several_steps_is_read(tmp_path):
    def steps(root):
        del root["CellData"]
        root.create_group("Steps").attrs["NSteps"] = 2
        root["Steps/NumberOfParts"] = [1, 1]
        root["Steps/PartOffsets"] = [0, 1]

    back = io.read(hand_made(tmp_path / "a.vtkhdf", steps))
    assert back.n_hexes == 1
    assert back.notes == ("Of its 2 time steps the first is read.",)


def replaced(**arrays):
    def change(root):
        for name, values in arrays.items():
            del root[name]
            root[name] = values

    return change


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (
            lambda root: root.attrs.__setitem__("Type", "ImageData"),
            "is of the type 'ImageData': expected UnstructuredGrid",
        ),
        (replaced(NumberOfPoints=[8]), "does not have the counts of its 1 part"),
        (replaced(NumberOfPoints=[8, 9]), "its Points ends after"),
        (replaced(Offsets=[0, 7, 0, 8]), "its Offsets of part 0 do not rise"),
        (replaced(Types=[12, 268]), "cell 1 is of type 268"),
        (replaced(Connectivity=np.arange(16) / 1), "its Connectivity are float64: expected whole numbers"),
        (replaced(Connectivity=np.full(16, 2**32 + 7)), "its parts|uses the nodes"),
        (lambda root: root.__delitem__("Types"), "has no array 'Types'"),
    ],
)
def test_what_is_wrong_is_named(change, words, tmp_path):
    def both(root):
        del root["CellData"]
        change(root)

    with pytest.raises(FileError, match=words):
        io.read(hand_made(tmp_path / "a.vtkhdf", both))


def test_a_small_file_cannot_fill_the_memory(tmp_path):
    def change(root):
        root.create_dataset("PointData/zeros", (16, 1 << 26), "f8", chunks=(1, 1 << 20))

    with pytest.raises(FileError, match="are declared to have"):
        io.read(hand_made(tmp_path / "a.vtkhdf", change))


def test_what_is_no_vtkhdf_is_said(tmp_path):
    with h5py.File(tmp_path / "a.vtkhdf", "w") as file:
        file["a"] = 1
    with pytest.raises(FileError, match="has no group VTKHDF"):
        io.read(tmp_path / "a.vtkhdf")
    content = hand_made(tmp_path / "b.vtkhdf").read_bytes()
    (tmp_path / "b.vtkhdf").write_bytes(content[: len(content) // 2])
    with pytest.raises(FileError, match=r"b\.vtkhdf: the HDF5 library cannot read it"):
        io.read(tmp_path / "b.vtkhdf")
