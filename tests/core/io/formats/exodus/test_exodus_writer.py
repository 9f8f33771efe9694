"""Written ExodusII files: read again, read by VTK, converted to HDF5; ids, pins and sets are kept."""

import numpy as np
import pytest

from hexmend import Cells, Mesh, io
from hexmend.io import Original, write_as_given
from hexmend.io.formats.exodus.netcdf3 import ClassicReader
from hexmend.mesh.hexahedron import UNIT_CUBE
from hexmend.mesh.second_order import MID_NODE_POSITIONS
from tests.core.grids import displaced, grid
from tests.core.io.formats.exodus.exodus_files import HEX27, letters, on_hdf5, rich, written
from tests.core.io.kept import assert_same, read_back


def test_hexes_of_both_orders_keep_their_data_and_sets(tmp_path):
    bare = grid(3, 1, 1)
    mids = np.full((3, 19), -1)
    mids[0, :12] = np.arange(16, 28)
    points = np.vstack([bare.points, bare.points[bare.hexes[0]].mean(axis=0) + MID_NODE_POSITIONS[:12]])
    mesh = Mesh(
        points, bare.hexes, mid_nodes=mids, hex_data={"p": np.arange(3.0)}, side_sets={"in": np.array([[0, 0], [2, 1]])}
    )
    back = read_back(tmp_path / "m.exo", mesh)
    own = {tuple(row): k for k, row in enumerate(back.hexes.tolist())}
    place = [own[tuple(row)] for row in mesh.hexes.tolist()]
    np.testing.assert_array_equal(back.mid_nodes[place], mesh.mid_nodes)
    np.testing.assert_array_equal(back.hex_data["p"][place], mesh.hex_data["p"])
    assert {(int(h), int(f)) for h, f in back.side_sets["in"]} == {(place[0], 0), (place[2], 1)}


def of_vtk(path):
    """Blocks of a file, read by VTK: name, type, points of each cell."""
    vtk = pytest.importorskip("vtk")
    from vtk.util.numpy_support import vtk_to_numpy

    reader = vtk.vtkExodusIIReader()
    reader.SetFileName(str(path))
    reader.Update()
    blocks = reader.GetOutput().GetBlock(0)
    for k in range(blocks.GetNumberOfBlocks()):
        grid_, name = blocks.GetBlock(k), blocks.GetMetaData(k).Get(vtk.vtkCompositeDataSet.NAME())
        points = vtk_to_numpy(grid_.GetPoints().GetData())
        cells = vtk_to_numpy(grid_.GetCells().GetConnectivityArray()).reshape(grid_.GetNumberOfCells(), -1)
        yield name, grid_.GetCellType(0), points[cells]


def test_vtk_reads_written_files(tmp_path):
    mesh = rich()
    io.write(tmp_path / "r.exo", mesh)
    found = list(of_vtk(tmp_path / "r.exo"))
    assert [(name, kind, len(cells)) for name, kind, cells in found][:2] == [("a", 12, 3), ("b", 12, 2)]
    np.testing.assert_array_equal(
        np.concatenate([cells for _, kind, cells in found if kind == 12]), mesh.points[mesh.hexes]
    )
    path = written(tmp_path / "one.exo", HEX27 / 2, [("HEX27", "", [range(1, 28)])])
    io.write(tmp_path / "again.exo", io.read(path))
    ((_, kind, cells),) = of_vtk(tmp_path / "again.exo")
    assert kind == 29
    np.testing.assert_array_equal(cells[0], np.concatenate([UNIT_CUBE, MID_NODE_POSITIONS]))


def test_a_file_on_hdf5_is_read_like_one_of_the_classic_format(tmp_path):
    pytest.importorskip("netCDF4")
    io.write(tmp_path / "classic.exo", rich())
    on_hdf5(tmp_path / "classic.exo", tmp_path / "new.exo", zlib=True)
    assert (tmp_path / "new.exo").read_bytes()[:4] == b"\x89HDF"
    mesh, back = io.read(tmp_path / "classic.exo"), io.read(tmp_path / "new.exo")
    assert_same(back, mesh)
    for kind in ("node_data", "hex_data"):
        for name, values in getattr(mesh, kind).items():
            np.testing.assert_array_equal(getattr(back, kind)[name], values, err_msg=name)


def test_ids_of_blocks_and_sets_are_kept(tmp_path):
    bare = grid(2)
    more = [
        ("eb_prop1", ("num_el_blk",), np.array([300, 20], np.int32)),
        ("ns_prop1", ("num_node_sets",), np.array([100], np.int32)),
        ("ns_names", ("num_node_sets", "len_name"), letters(["inlet"])),
        ("node_ns1", ("num_nod_ns1",), np.array([1, 27], np.int32)),
        ("ss_prop1", ("num_side_sets",), np.array([200], np.int32)),
        ("elem_ss1", ("num_side_ss1",), np.array([8], np.int32)),
        ("side_ss1", ("num_side_ss1",), np.array([6], np.int32)),
    ]
    blocks = [("HEX8", "", bare.hexes + 1), ("SHELL4", "", bare.hexes[:1, 4:] + 1)]
    mesh = io.read(written(tmp_path / "m.exo", bare.points, blocks, more))
    assert io.unsupported_data(tmp_path / "again.exo", mesh) == []
    io.write(tmp_path / "again.exo", mesh.replace(node_sets={"new": np.array([3]), **mesh.node_sets}))
    from scipy.io import netcdf_file

    with netcdf_file(tmp_path / "again.exo", mmap=False) as file:
        ids = {name: file.variables[name + "_prop1"][:].tolist() for name in ("eb", "ns", "ss")}
    assert ids == {"eb": [300, 20], "ns": [101, 100], "ss": [200]}


def test_columns_with_the_names_of_other_data_are_renamed_together_and_that_is_reported(tmp_path):
    rng = np.random.default_rng(0)
    vector, pair, scalar = rng.normal(size=(27, 3)), rng.normal(size=(27, 2)), rng.normal(size=27)
    nodes = {"v": vector, "v_x": scalar, "w": pair, "w_3": scalar, "free": vector}
    mesh = grid(2).replace(node_data=nodes, hex_data={"s": rng.normal(size=(8, 3)), "s_z": np.arange(8.0)})
    assert io.unsupported_data(tmp_path / "a.exo", mesh) == [
        "names of point data as they are (v, w)",
        "names of cell data as they are (s)",
    ]
    back = read_back(tmp_path / "a.exo", mesh)
    assert set(back.node_data) == {"v_2", "v_x", "w_2", "w_3", "free"}
    assert set(back.hex_data) == {"s_2", "s_z"}
    for title, values in {"v_2": vector, "v_x": scalar, "w_2": pair, "w_3": scalar, "free": vector}.items():
        np.testing.assert_array_equal(back.node_data[title], values)
    np.testing.assert_array_equal(back.hex_data["s_2"], mesh.hex_data["s"])


def test_the_header_gives_the_width_of_ids(tmp_path):
    netCDF4 = pytest.importorskip("netCDF4")
    most = 2**31 - 1
    io.write(tmp_path / "a.exo", grid(2).replace(hex_data={"id": np.arange(8) + most - 7}))
    with netCDF4.Dataset(tmp_path / "a.exo") as file:
        assert (file.int64_status, file.file_size, file.floating_point_word_size) == (0, 1, 8)
        assert file.api_version == file.version == np.float32(8.03)
        assert file["elem_num_map"][:].max() == most


def test_cells_without_ids_follow_the_highest_one(tmp_path):
    lines = [Cells("line", np.array([[k, k + 1]], np.int32)) for k in range(2)]
    io.write(tmp_path / "a.exo", grid(2).replace(hex_data={"id": np.arange(8) + 10}, cells=tuple(lines)))
    netCDF4 = pytest.importorskip("netCDF4")
    with netCDF4.Dataset(tmp_path / "a.exo") as file:
        assert file["elem_num_map"][:].tolist() == list(range(10, 20))


# Coordinates replaced in ExodusII files of all containers, types and layouts.


h5py = pytest.importorskip("h5py")


def moved(mesh):
    return displaced(mesh, np.s_[::3], 0.01 * np.random.default_rng(3).normal(size=mesh.points[::3].shape))


def replaced(source, target):
    given = io.read(source)
    mesh = moved(given)
    written = write_as_given(target, mesh, Original(source, given))
    assert written.replaced, written.notes
    again = io.read(target)
    assert_same(again.with_points(mesh.points), mesh)
    return mesh, again, written


def test_a_classic_file_keeps_each_byte_that_is_no_coordinate(tmp_path):
    io.write(tmp_path / "a.exo", rich())
    mesh, again, _ = replaced(tmp_path / "a.exo", tmp_path / "b.exo")
    np.testing.assert_array_equal(again.points, mesh.points)
    given, data = (bytearray((tmp_path / name).read_bytes()) for name in ("a.exo", "b.exo"))
    store = ClassicReader(tmp_path / "a.exo")
    for name in ("coordx", "coordy", "coordz"):
        variable = store.variable(name)
        for one in (given, data):
            one[variable.begin : variable.begin + variable.data_size] = bytes(variable.data_size)
    assert given == data


@pytest.mark.parametrize("kind", ["f8", "f4"])
def test_compressed_coordinates_are_written_by_the_library(kind, tmp_path):
    io.write(tmp_path / "a.exo", rich())
    on_hdf5(tmp_path / "a.exo", tmp_path / "b.exo", zlib=True, kind=kind)
    mesh, again, written = replaced(tmp_path / "b.exo", tmp_path / "c.exo")
    np.testing.assert_allclose(again.points, mesh.points, rtol=0, atol=0 if kind == "f8" else 1e-6)
    assert any("32-bit" in note for note in written.notes) == (kind == "f4")
    with h5py.File(tmp_path / "b.exo") as one, h5py.File(tmp_path / "c.exo") as other:
        assert list(one) == list(other)
        assert other["coordx"].dtype == kind
        for name in one:
            if not name.startswith("coord"):
                np.testing.assert_array_equal(one[name][()], other[name][()])
                assert dict(one[name].attrs).keys() == dict(other[name].attrs).keys()
