"""Reading ExodusII files of other programs."""

import shutil
import struct

import numpy as np
import pytest

from hexmend import FileError, io
from hexmend.mesh.hexahedron import FACES, UNIT_CUBE
from hexmend.mesh.second_order import MID_NODE_POSITIONS
from tests.core.grids import grid
from tests.core.io.formats.exodus.exodus_files import HEX27, SIDES, letters, written
from tests.core.io.kept import read_back


@pytest.mark.parametrize("width", [8, 20, 27])
def test_nodes_of_every_order_have_vtks_order(width, tmp_path):
    path = written(tmp_path / "one.exo", HEX27[:width] / 2, [(f"HEX{width}", "", [range(1, width + 1)])])
    mesh = io.read(path)
    np.testing.assert_array_equal(mesh.points[mesh.hexes[0]], UNIT_CUBE)
    if width > 8:
        np.testing.assert_array_equal(mesh.points[mesh.mid_nodes[0, : width - 8]], MID_NODE_POSITIONS[: width - 8])
    again = read_back(tmp_path / "again.exo", mesh)
    np.testing.assert_array_equal(again.hexes, mesh.hexes)
    np.testing.assert_array_equal(again.mid_nodes, mesh.mid_nodes)


def test_nodes_of_a_wedge_of_second_order_have_vtks_order(tmp_path):
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
    np.testing.assert_array_equal(read_back(tmp_path / "t.exo", mesh).side_sets["skin"], mesh.side_sets["skin"])


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
    np.testing.assert_array_equal(io.read(tmp_path / "other.dat").hexes, mesh.hexes)  # whatever its suffix


def test_cells_of_unknown_types_are_left_out_with_a_note(tmp_path):
    blocks = [("HEX8", "", [range(1, 9)]), ("RICH", "", [range(1, 8)])]
    mesh = io.read(written(tmp_path / "u.exo", UNIT_CUBE, blocks))
    assert mesh.n_hexes == 1
    assert any("RICH" in note for note in mesh.notes)


@pytest.mark.parametrize("kind", ["BEX_HEX", "HEXSHELL", "NFACED", ""])
def test_a_file_without_hexes_is_refused_with_the_types_that_it_has(kind, tmp_path):
    blocks = [(kind, "", [range(1, 9)]), ("TRI3", "", [range(1, 4)])]
    words = f"holds no hexahedra, but 1 triangle cell and 1 cell of type {kind or 'unnamed'} in block 1"
    with pytest.raises(FileError, match=words):
        io.read(written(tmp_path / "b.exo", UNIT_CUBE, blocks))


@pytest.mark.parametrize("kind", ["HEX", "hex8", "HEXA", "Hexahedron", "HEX_8"])
def test_hexes_are_recognised_by_all_names_of_their_type(kind, tmp_path):
    assert io.read(written(tmp_path / "h.exo", UNIT_CUBE, [(kind, "", [range(1, 9)])])).n_hexes == 1


def test_data_that_are_not_kept_are_noted(tmp_path):
    more = [
        ("node_ns1", ("num_nod_ns1",), np.array([1, 3], np.int32)),
        ("dist_fact_ns1", ("num_nod_ns1",), np.array([1.0, 1])),
        ("ns_status", ("num_node_sets",), np.array([1], np.int32)),
        ("elem_ss1", ("num_side_ss1",), np.array([1], np.int32)),
        ("side_ss1", ("num_side_ss1",), np.array([2], np.int32)),
        ("ss_status", ("num_side_sets",), np.array([1], np.int32)),
    ]
    blocks = [("HEX8", "", [range(1, 9)])]
    factors = [("dist_fact_ss1", ("num_df_ss1",), np.array([1, 1, 0.5, 1]))]
    globals_ = [("name_glo_var", ("num_glo_var", "len_name"), letters(["energy"]))]
    assert io.read(written(tmp_path / "a.exo", UNIT_CUBE, blocks, more)).notes == ()  # factors of 1 are the default
    mesh = io.read(written(tmp_path / "b.exo", UNIT_CUBE, blocks, [*more, *factors, *globals_]))
    words = "Not read: distribution factors other than 1, global variables."
    assert mesh.notes == (words,)


def test_a_node_set_named_fixed_pins_its_nodes_and_stays_a_set(tmp_path):
    more = [
        ("ns_names", ("num_node_sets", "len_name"), letters(["Fixed", "FIXED"])),
        ("node_ns1", ("num_nod_ns1",), np.array([1, 3], np.int32)),
        ("node_ns2", ("num_nod_ns2",), np.array([8], np.int32)),
    ]
    mesh = io.read(written(tmp_path / "f.exo", UNIT_CUBE, [("HEX", "", [range(1, 9)])], more))
    assert np.flatnonzero(mesh.pinned).tolist() == [0, 2, 7]
    assert {name: one.tolist() for name, one in mesh.node_sets.items()} == {"Fixed": [0, 2], "FIXED": [7]}


@pytest.mark.parametrize("steps", [1, 3])
def test_a_note_says_that_the_last_of_several_time_steps_is_read(steps, tmp_path):
    more = [
        ("name_nod_var", ("num_nod_var", "len_name"), letters(["T"])),
        ("vals_nod_var1", ("time_step", "num_nodes"), np.arange(steps * 8.0).reshape(steps, 8)),
    ]
    mesh = io.read(written(tmp_path / "t.exo", UNIT_CUBE, [("HEX8", "", [range(1, 9)])], more))
    assert mesh.node_data["T"][0] == 8 * (steps - 1)
    assert mesh.notes == (("Not read: all 3 time steps but the last.",) if steps == 3 else ())


# Truncated or inconsistent ExodusII files, and other NetCDF files, give one clear error each.


def test_counts_larger_than_the_file_are_refused_before_anything_is_allocated(tmp_path):
    io.write(tmp_path / "good.exo", grid(2))
    data = (tmp_path / "good.exo").read_bytes()
    place = data.index(b"num_nodes") + 12
    (tmp_path / "bad.exo").write_bytes(data[:place] + struct.pack(">i", 2**31 - 1) + data[place + 4 :])
    with pytest.raises(FileError, match="the file ends at byte"):
        io.read(tmp_path / "bad.exo")


@pytest.mark.parametrize("huge", ["num_nodes", "num_el_blk", "num_el_in_blk1"])
def test_huge_dimensions_on_hdf5_without_values_are_refused(huge, tmp_path):
    """HDF5 allocates no space for an array without values, whatever its size."""
    netCDF4 = pytest.importorskip("netCDF4")
    with netCDF4.Dataset(tmp_path / "a.exo", "w") as file:
        lengths = {"num_nodes": 8, "num_nod_per_el1": 8, "num_dim": 3}
        lengths |= dict.fromkeys(("num_elem", "num_el_blk", "num_el_in_blk1"), 1) | {huge: 2**40}
        for one, length in lengths.items():
            file.createDimension(one, length)
        for axis in "xyz":
            file.createVariable(f"coord{axis}", "f8", ("num_nodes",))
        file.createVariable("connect1", "i4", ("num_el_in_blk1", "num_nod_per_el1")).elem_type = "HEX8"
    with pytest.raises(FileError, match=r"a\.exo: .*(more than a file of its size holds|of \d+ variables)"):
        io.read(tmp_path / "a.exo")


def test_netcdf_that_is_no_exodus_is_not_called_damaged(tmp_path):
    from scipy.io import netcdf_file

    with netcdf_file(tmp_path / "weather.exo", "w") as file:
        file.createDimension("lat", 3)
        file.createVariable("t", "d", ("lat",))[:] = [1, 2, 3]
    with pytest.raises(FileError, match="no dimension num_nodes") as caught:
        io.read(tmp_path / "weather.exo")
    assert "damaged" not in str(caught.value)
