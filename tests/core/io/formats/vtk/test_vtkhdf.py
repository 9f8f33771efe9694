"""VTKHDF as VTK's own writer makes it, and what is wrong with others."""

import numpy as np
import pytest

from hexmend import FileError, io
from tests.core.grids import grid, scrambled

h5py = pytest.importorskip("h5py")


def test_vtk_reads_what_is_written(tmp_path):
    pyvista = pytest.importorskip("pyvista")
    data = {"a": np.arange(64.0), "tensors": np.arange(576.0).reshape(64, 3, 3), "none": np.zeros((64, 0))}
    fields = {"title": ["x", "ä"], "no texts": [], "empty": np.zeros(0), "deep": np.ones((2, 3, 3))}
    marks = {"a/b": np.ones(27), "true": np.arange(27) > 5}
    mesh = scrambled(grid(3), 0.3).replace(node_data=data, hex_data=marks, field_data=fields)
    assert io.unsupported_data(tmp_path / "a.vtkhdf", mesh) == ["names of data and sets as they are (a/b)"]
    io.write(tmp_path / "a.vtkhdf", mesh)
    found = io.read(tmp_path / "a.vtkhdf").hex_data
    assert (found["a_b"] == 1).all()
    assert (found["true"].tolist(), found["true"].dtype) == (marks["true"].tolist(), np.uint8)
    other = pyvista.read(tmp_path / "a.vtkhdf")
    np.testing.assert_array_equal(other.point_data["tensors"].reshape(64, 3, 3), data["tensors"])
    assert list(other.field_data["title"]) == fields["title"]


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


WRONG_CHANGES = [
    (lambda root: root.attrs.__setitem__("Type", "ImageData"), "is of the type 'ImageData': expected UnstructuredGrid"),
    (replaced(NumberOfPoints=[8]), "does not have the counts of its 1 part"),
    (replaced(NumberOfPoints=[8, 9]), "its Points ends after"),
    (replaced(Offsets=[0, 7, 0, 8]), "its Offsets of part 0 do not rise"),
    (replaced(Types=[12, 268]), "cell 1 is of type 268"),
    (replaced(Connectivity=np.arange(16) / 1), "its Connectivity are float64: expected whole numbers"),
    (replaced(Connectivity=np.full(16, 2**32 + 7)), "its parts|uses the nodes"),
    (lambda root: root.__delitem__("Types"), "has no array 'Types'"),
]


@pytest.mark.parametrize(("change", "words"), WRONG_CHANGES)
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
