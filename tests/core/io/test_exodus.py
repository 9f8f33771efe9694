"""ExodusII: files of other programs node by node and side by side, and what is written for them."""

import shutil
import struct

import numpy as np
import pytest

from hexmend import io
from hexmend.errors import FileError
from hexmend.hexahedron import FACES, UNIT_CUBE
from hexmend.mesh import Cells, Mesh
from hexmend.second_order import MID_PLACES
from tests.core.grids import grid

#: Twice the places of a HEX27's nodes in the unit cube, as the manual's figure has them, from node 1 on.
HEX27 = np.array(
    [
        [0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0], [0, 0, 2], [2, 0, 2], [2, 2, 2], [0, 2, 2],
        [1, 0, 0], [2, 1, 0], [1, 2, 0], [0, 1, 0], [0, 0, 1], [2, 0, 1], [2, 2, 1], [0, 2, 1],
        [1, 0, 2], [2, 1, 2], [1, 2, 2], [0, 1, 2], [1, 1, 1], [1, 1, 0], [1, 1, 2], [0, 1, 1],
        [2, 1, 1], [1, 0, 1], [1, 2, 1],
    ]
)  # fmt: skip
#: Nodes of a hex's sides 1 to 6, from the manual.
SIDES = [[1, 2, 6, 5], [2, 3, 7, 6], [3, 4, 8, 7], [1, 5, 8, 4], [1, 4, 3, 2], [5, 6, 7, 8]]


def letters(words):
    return np.array([list(word.ljust(33, "\0").encode()) for word in words], np.uint8).view("S1").reshape(-1, 33)


def written(path, points, blocks, more=(), title="by another library"):
    """An Exodus file by SciPy's NetCDF: blocks are (type, name, nodes from 1), more (name, dimensions, values)."""
    from scipy.io import netcdf_file

    with netcdf_file(path, "w", version=2) as file:
        file.title = title
        file.createDimension("time_step", None)
        lengths = {"len_name": 33, "num_dim": 3, "num_nodes": len(points), "num_el_blk": len(blocks)}
        lengths["num_elem"] = sum(len(nodes) for _, _, nodes in blocks)
        for name, length in lengths.items():
            file.createDimension(name, length)
        variables = [(f"coord{c}", ("num_nodes",), points[:, k].astype(float)) for k, c in enumerate("xyz")]
        variables.append(("eb_names", ("num_el_blk", "len_name"), letters([name for _, name, _ in blocks])))
        for k, (_, _, nodes) in enumerate(blocks, 1):
            nodes = np.asarray(nodes, np.int32)
            for name, length in zip((f"num_el_in_blk{k}", f"num_nod_per_el{k}"), nodes.shape, strict=True):
                file.createDimension(name, length)
            variables.append((f"connect{k}", (f"num_el_in_blk{k}", f"num_nod_per_el{k}"), nodes))
        for name, dimensions, values in [*variables, *more]:
            values = np.asarray(values)
            for one, length in zip(dimensions, values.shape, strict=True):
                if one not in file.dimensions:
                    file.createDimension(one, length)
            kind = {"S": "c", "i": "i", "f": "d"}[values.dtype.kind]
            file.createVariable(name, kind, dimensions)[:] = values
        for k, (kind, _, _) in enumerate(blocks, 1):
            file.variables[f"connect{k}"].elem_type = kind
    return path


@pytest.mark.parametrize("width", [8, 20, 27])
def test_nodes_of_every_order_are_where_vtk_has_them(width, tmp_path):
    path = written(tmp_path / "one.exo", HEX27[:width] / 2, [(f"HEX{width}", "", [range(1, width + 1)])])
    mesh = io.read(path)
    np.testing.assert_array_equal(mesh.points[mesh.hexes[0]], UNIT_CUBE)
    if width > 8:
        np.testing.assert_array_equal(mesh.points[mesh.mid_nodes[0, : width - 8]], MID_PLACES[: width - 8])
    io.write(tmp_path / "again.exo", mesh)
    again = io.read(tmp_path / "again.exo")
    np.testing.assert_array_equal(again.hexes, mesh.hexes)
    np.testing.assert_array_equal(again.mid_nodes, mesh.mid_nodes)


def test_nodes_of_a_wedge_of_second_order_are_where_vtk_has_them(tmp_path):
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [0, 1, 1]]) + [3.0, 0, 0]
    ends = [(0, 1), (1, 2), (2, 0), (0, 3), (1, 4), (2, 5), (3, 4), (4, 5), (5, 3)]  # the manual's nodes 7 to 15
    points = np.concatenate([UNIT_CUBE, corners, [corners[list(pair)].mean(axis=0) for pair in ends]])
    path = written(tmp_path / "w.exo", points, [("HEX8", "", [range(1, 9)]), ("WEDGE15", "", [range(9, 24)])])
    (wedge,) = io.read(path).cells
    assert wedge.kind == "wedge15"
    vtk_ends = [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)]
    for place, pair in enumerate(vtk_ends, 6):
        np.testing.assert_array_equal(points[wedge.nodes[0, place]], corners[list(pair)].mean(axis=0))


def test_sides_are_faces(tmp_path):
    sides = np.arange(1, 7)
    more = [
        ("ss_names", ("num_side_sets", "len_name"), letters(["skin"])),
        ("elem_ss1", ("num_side_ss1",), np.ones(6, np.int32)),
        ("side_ss1", ("num_side_ss1",), sides.astype(np.int32)),
    ]
    mesh = io.read(written(tmp_path / "s.exo", UNIT_CUBE, [("HEX", "", [range(1, 9)])], more))
    for (hex_, face), nodes in zip(mesh.side_sets["skin"], SIDES, strict=True):
        assert set(mesh.hexes[hex_][FACES[face]] + 1) == set(nodes)
    io.write(tmp_path / "t.exo", mesh)
    np.testing.assert_array_equal(io.read(tmp_path / "t.exo").side_sets["skin"], mesh.side_sets["skin"])


def test_blocks_sets_ids_attributes_and_the_last_step_are_read(tmp_path):
    bare = grid(2)
    steps = np.arange(2.0)
    more = [
        ("node_num_map", ("num_nodes",), np.arange(27, dtype=np.int32) + 100),
        ("elem_num_map", ("num_elem",), np.arange(9, dtype=np.int32) * 10),
        ("eb_prop1", ("num_el_blk",), np.array([7, 9, 11], np.int32)),
        ("ns_prop1", ("num_node_sets",), np.array([5], np.int32)),
        ("node_ns1", ("num_nod_ns1",), np.array([1, 27], np.int32)),
        ("elem_els1", ("num_ele_els1",), np.array([2, 8, 9], np.int32)),
        ("els_prop1", ("num_elem_sets",), np.array([4], np.int32)),
        ("elem_ss1", ("num_side_ss1",), np.array([9, 8], np.int32)),
        ("side_ss1", ("num_side_ss1",), np.array([1, 6], np.int32)),
        ("ss_names", ("num_side_sets", "len_name"), letters(["top"])),
        ("attrib3", ("num_el_in_blk3", "num_att_in_blk3"), np.array([[0.25]])),
        ("time_whole", ("time_step",), steps),
        ("name_nod_var", ("num_nod_var", "len_name"), letters(["v_x", "v_y", "v_z", "T"])),
        ("name_elem_var", ("num_elem_var", "len_name"), letters(["p"])),
        *((f"vals_nod_var{v}", ("time_step", "num_nodes"), steps[:, None] * np.arange(27) * v) for v in (1, 2, 3, 4)),
        ("vals_elem_var1eb2", ("time_step", "num_el_in_blk2"), steps[:, None] * [3, 4, 5]),
    ]
    hexes = bare.hexes + 1
    blocks = [("HEX8", "iron", hexes[:5]), ("HEX8", "lead", hexes[5:]), ("SHELL4", "lid", hexes[:1, 4:])]
    mesh = io.read(written(tmp_path / "m.exo", bare.points, blocks, more))
    assert mesh.node_data["id"].tolist() == list(range(100, 127))
    assert mesh.hex_data["id"].tolist() == list(range(0, 80, 10))
    assert {name: list(members) for name, members in mesh.hex_sets.items()} == {
        "iron": [0, 1, 2, 3, 4], "lead": [5, 6, 7], "element set 4": [1, 7],
    }  # fmt: skip
    assert mesh.node_sets["node set 5"].tolist() == [0, 26]
    assert mesh.side_sets["top"].tolist() == [[7, 5]]
    assert any("1 sides of other cells in 'top'" in note for note in mesh.notes)
    (lid,) = mesh.cells
    assert lid.data["attribute 1"].tolist() == [0.25]
    assert lid.data["id"].tolist() == [80]
    assert set(lid.sets) == {"lid", "element set 4"}
    np.testing.assert_array_equal(mesh.node_data["v"], np.arange(27)[:, None] * [1.0, 2, 3])
    np.testing.assert_array_equal(mesh.node_data["T"], np.arange(27) * 4.0)
    np.testing.assert_array_equal(mesh.hex_data["p"], [*[np.nan] * 5, 3, 4, 5])  # the first block has no such variable


def rich() -> Mesh:
    bare = grid(2)
    return bare.replace(
        node_data={"id": np.arange(27) + 2**40, "v": np.random.default_rng(1).normal(size=(27, 3))},
        hex_data={"id": np.arange(8)[::-1] + 3, "tensor": np.arange(48.0).reshape(8, 6)},
        node_sets={"wall": np.array([0, 26])},
        hex_sets={"a": np.array([0, 1, 2]), "b": np.array([3, 4]), "scattered": np.array([0, 4, 7])},
        side_sets={"in": np.array([[0, 0], [2, 0]]), "out": np.array([[7, 5], [1, 2]])},
        cells=(Cells("quad", bare.hexes[:2, :4], {"t": np.array([1.5, 2])}, {"lid": np.array([1])}),),
        pinned=np.arange(27) == 13,
    )


def test_all_that_is_held_is_read_again(tmp_path):
    mesh = rich()
    assert io.left_out(tmp_path / "r.exo", mesh) == []
    io.write(tmp_path / "r.exo", mesh)
    back = io.read(tmp_path / "r.exo")
    np.testing.assert_array_equal(back.hexes, mesh.hexes)
    for kind in ("node_data", "hex_data", "node_sets", "hex_sets", "side_sets"):
        mine, its = getattr(mesh, kind), getattr(back, kind)
        assert set(mine) == set(its), kind
        for name, values in mine.items():
            np.testing.assert_array_equal(its[name], values, err_msg=name)
    np.testing.assert_array_equal(back.pinned, mesh.pinned)
    assert back.cells[0].sets["lid"].tolist() == [1]
    assert back.cells[0].data["t"].tolist() == [1.5, 2]


def test_hexes_of_both_orders_keep_what_is_said_of_each(tmp_path):
    bare = grid(3, 1, 1)
    mids = np.full((3, 19), -1)
    mids[0, :12] = np.arange(16, 28)
    points = np.vstack([bare.points, bare.points[bare.hexes[0]].mean(axis=0) + MID_PLACES[:12]])
    mesh = Mesh(
        points, bare.hexes, mid_nodes=mids, hex_data={"p": np.arange(3.0)}, side_sets={"in": np.array([[0, 0], [2, 1]])}
    )
    io.write(tmp_path / "m.exo", mesh)
    back = io.read(tmp_path / "m.exo")
    own = {tuple(row): k for k, row in enumerate(back.hexes.tolist())}
    place = [own[tuple(row)] for row in mesh.hexes.tolist()]
    np.testing.assert_array_equal(back.mid_nodes[place], mesh.mid_nodes)
    np.testing.assert_array_equal(back.hex_data["p"][place], mesh.hex_data["p"])
    assert {(int(h), int(f)) for h, f in back.side_sets["in"]} == {(place[0], 0), (place[2], 1)}


@pytest.mark.parametrize("name", ["jet.exo"])
def test_a_real_file_has_its_sides_on_the_boundary(name, real_mesh, tmp_path):
    mesh = io.read(real_mesh(name))
    assert mesh.n_hexes == 12228
    assert [len(rows) for rows in mesh.side_sets.values()] == [132, 108, 120, 204, 252]
    outside = {tuple(row) for row in np.sort(mesh.topology.boundary_faces, axis=1).tolist()}
    for rows in mesh.side_sets.values():
        faces = np.sort(mesh.hexes[rows[:, :1], FACES[rows[:, 1]]], axis=1)
        assert outside.issuperset(map(tuple, faces.tolist()))
    shutil.copy(real_mesh(name), tmp_path / "other.dat")
    np.testing.assert_array_equal(io.read(tmp_path / "other.dat").hexes, mesh.hexes)  # whatever it is called


def of_vtk(path):
    """Blocks of a file by VTK: name, type, points of each cell."""
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


def test_vtk_reads_what_is_written(tmp_path):
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
    np.testing.assert_array_equal(cells[0], np.concatenate([UNIT_CUBE, MID_PLACES]))


def test_a_file_on_hdf5_is_read_as_one_of_the_classic_format(tmp_path):
    netCDF4 = pytest.importorskip("netCDF4")
    io.write(tmp_path / "classic.exo", rich())
    with netCDF4.Dataset(tmp_path / "classic.exo") as one, netCDF4.Dataset(tmp_path / "new.exo", "w") as other:
        one.set_auto_mask(False)
        for name, dimension in one.dimensions.items():
            other.createDimension(name, None if dimension.isunlimited() else len(dimension))
        for name, values in one.variables.items():
            copy = other.createVariable(name, values.dtype, values.dimensions, zlib=True)
            copy.setncatts({key: values.getncattr(key) for key in values.ncattrs()})
            copy[:] = values[:]
    assert (tmp_path / "new.exo").read_bytes()[:4] == b"\x89HDF"
    mesh, back = io.read(tmp_path / "classic.exo"), io.read(tmp_path / "new.exo")
    np.testing.assert_array_equal(back.hexes, mesh.hexes)
    for kind in ("node_data", "hex_data", "node_sets", "hex_sets", "side_sets"):
        for name, values in getattr(mesh, kind).items():
            np.testing.assert_array_equal(getattr(back, kind)[name], values, err_msg=name)


def test_every_cut_of_a_file_is_refused(tmp_path):
    io.write(tmp_path / "good.exo", grid(2))
    data = (tmp_path / "good.exo").read_bytes()
    for length in range(4, len(data), 37):
        (tmp_path / "cut.exo").write_bytes(data[:length])
        with pytest.raises(FileError, match=r"cut\.exo: "):
            io.read(tmp_path / "cut.exo")


def test_counts_larger_than_the_file_are_refused_before_anything_is_allocated(tmp_path):
    io.write(tmp_path / "good.exo", grid(2))
    data = (tmp_path / "good.exo").read_bytes()
    place = data.index(b"num_nodes") + 12
    (tmp_path / "bad.exo").write_bytes(data[:place] + struct.pack(">i", 2**31 - 1) + data[place + 4 :])
    with pytest.raises(FileError, match="the file ends at byte"):
        io.read(tmp_path / "bad.exo")


def test_dimensions_on_hdf5_that_nothing_fills_are_refused(tmp_path):
    """HDF5 keeps an array of any size that nobody has written to in no space at all."""
    netCDF4 = pytest.importorskip("netCDF4")
    for name, dimension in (
        ("nodes.exo", "num_nodes"),
        ("blocks.exo", "num_el_blk"),
        ("elements.exo", "num_el_in_blk1"),
    ):
        with netCDF4.Dataset(tmp_path / name, "w") as file:
            lengths = {
                "num_nodes": 8,
                "num_elem": 1,
                "num_el_blk": 1,
                "num_el_in_blk1": 1,
                "num_nod_per_el1": 8,
                "num_dim": 3,
            }
            for one, length in (lengths | {dimension: 2**40}).items():
                file.createDimension(one, length)
            for axis in "xyz":
                file.createVariable(f"coord{axis}", "f8", ("num_nodes",))
            file.createVariable("connect1", "i4", ("num_el_in_blk1", "num_nod_per_el1")).elem_type = "HEX8"
        with pytest.raises(FileError, match=rf"{name}: .*(more than a file of its size holds|of \d+ variables)"):
            io.read(tmp_path / name)


def test_netcdf_that_is_no_exodus_is_not_called_damaged(tmp_path):
    from scipy.io import netcdf_file

    with netcdf_file(tmp_path / "weather.exo", "w") as file:
        file.createDimension("lat", 3)
        file.createVariable("t", "d", ("lat",))[:] = [1, 2, 3]
    with pytest.raises(FileError, match="no dimension num_nodes") as caught:
        io.read(tmp_path / "weather.exo")
    assert "damaged" not in str(caught.value)


def test_cells_of_unknown_types_are_left_out_and_that_is_said(tmp_path):
    blocks = [("HEX8", "", [range(1, 9)]), ("RICH", "", [range(1, 8)])]
    mesh = io.read(written(tmp_path / "u.exo", UNIT_CUBE, blocks))
    assert mesh.n_hexes == 1
    assert any("RICH" in note for note in mesh.notes)


def test_a_set_of_nodes_called_fixed_makes_pins_and_stays_a_set(tmp_path):
    more = [
        ("ns_names", ("num_node_sets", "len_name"), letters(["Fixed", "FIXED"])),
        ("node_ns1", ("num_nod_ns1",), np.array([1, 3], np.int32)),
        ("node_ns2", ("num_nod_ns2",), np.array([8], np.int32)),
    ]
    mesh = io.read(written(tmp_path / "f.exo", UNIT_CUBE, [("HEX", "", [range(1, 9)])], more))
    assert np.flatnonzero(mesh.pinned).tolist() == [0, 2, 7]
    assert {name: one.tolist() for name, one in mesh.node_sets.items()} == {"Fixed": [0, 2], "FIXED": [7]}


@pytest.mark.parametrize("pins", [[], [1, 4]])
@pytest.mark.parametrize("name", ["fixed", "Fixed"])
def test_pins_and_sets_called_fixed_are_kept_apart(name, pins, tmp_path):
    mesh = grid(2).replace(node_sets={name: np.array([0, 9])}, pinned=np.isin(np.arange(27), pins))
    io.write(tmp_path / "f.exo", mesh)
    back = io.read(tmp_path / "f.exo")
    assert np.flatnonzero(back.pinned if back.pinned is not None else []).tolist() == pins
    assert {key: one.tolist() for key, one in back.node_sets.items()} == {name: [0, 9]}


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
    assert io.left_out(tmp_path / "again.exo", mesh) == []
    io.write(tmp_path / "again.exo", mesh.replace(node_sets={"new": np.array([3]), **mesh.node_sets}))
    from scipy.io import netcdf_file

    with netcdf_file(tmp_path / "again.exo", mmap=False) as file:
        ids = {name: file.variables[name + "_prop1"][:].tolist() for name in ("eb", "ns", "ss")}
    assert ids == {"eb": [300, 20], "ns": [101, 100], "ss": [200]}


@pytest.mark.parametrize("steps", [1, 3])
def test_that_one_of_several_time_steps_is_read_is_said(steps, tmp_path):
    more = [
        ("name_nod_var", ("num_nod_var", "len_name"), letters(["T"])),
        ("vals_nod_var1", ("time_step", "num_nodes"), np.arange(steps * 8.0).reshape(steps, 8)),
    ]
    mesh = io.read(written(tmp_path / "t.exo", UNIT_CUBE, [("HEX8", "", [range(1, 9)])], more))
    assert mesh.node_data["T"][0] == 8 * (steps - 1)
    assert mesh.notes == (("Of 3 time steps the last is read.",) if steps == 3 else ())
