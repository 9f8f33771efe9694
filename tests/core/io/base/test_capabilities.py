"""What a format is declared to hold comes back as it was; what it is not, is said before it is lost."""

import numpy as np
import pytest

from hexmend import Cells, FileError, Mesh, io
from hexmend.io import FORMATS
from hexmend.io.base.format import Capability
from hexmend.mesh.second_order import MID_NODE_POSITIONS
from tests.core.grids import grid
from tests.core.io.kept import read_back

WAYS = [(name, encoding) for name, one in FORMATS.items() for encoding in one.encodings]
SPACED = np.arange(27) * 3 + 10


def in_new_folder(folder, name):
    """A path in a folder of its own, since a case of OpenFOAM fills one."""
    (folder / name).mkdir()
    return folder / name / name


def quadratic(width):
    """Two hexes with as many nodes, in a row."""
    rows, points = [], []
    corners = grid(2, 1, 1)
    for x in range(2):
        whole = np.concatenate([corners.points[corners.hexes[0]], MID_NODE_POSITIONS])[:width] * 2 + [2 * x, 0, 0]
        rows.append([points.index(p) if p in points else points.append(p) or len(points) - 1 for p in whole.tolist()])
    rows = np.array(rows)
    return Mesh(points, rows[:, :8], mid_nodes=np.pad(rows[:, 8:], ((0, 0), (0, 27 - width)), constant_values=-1))


def beside(kind, nodes, more=(), **said):
    """The grid and cells of another kind."""
    mesh = grid(2)
    points = np.vstack([mesh.points, np.reshape(np.array(more, float), (-1, 3))])
    return Mesh(points, mesh.hexes, cells=(Cells(kind, np.array(nodes, np.int32), **said),))


#: Meshes that each have one thing; the numbers are such as every decimal and binary form holds.
MESHES = {
    Capability.NODE_DATA: [
        grid(2).replace(node_data={"temperature": np.arange(27) / 4}),
        grid(2).replace(node_data={"velocity": np.arange(81.0).reshape(27, 3) / 8}),
    ],
    Capability.HEX_DATA: [grid(2).replace(hex_data={"pressure": np.arange(8) / 4})],
    Capability.IDS: [
        grid(2).replace(node_data={"id": SPACED}, hex_data={"id": SPACED[:8] + 7}),
        grid(2).replace(node_data={"id": SPACED[::-1].copy()}, hex_data={"id": np.roll(SPACED[:8], 3)}),
    ],
    Capability.NODE_SETS: [grid(2).replace(node_sets={"inlet": np.array([0, 3, 26]), "all": np.arange(27)})],
    Capability.HEX_SETS: [grid(2).replace(hex_sets={"steel": np.array([1, 4]), "air": np.array([0, 2, 3, 5, 6, 7])})],
    Capability.SIDE_SETS: [grid(2).replace(side_sets={"wall": np.array([[0, 0], [0, 2], [7, 5]]), "top": np.array([[5, 1]])})],
    Capability.EMPTY_SETS: [grid(2).replace(hex_sets={"left": np.array([], int)}, node_sets={"right": np.array([], int)})],
    Capability.CELL_SETS: [beside("quad", grid(2).topology.boundary_faces[:3], sets={"inlet": [0, 2], "wall": [1]})],
    Capability.FIXED_NODES: [grid(3).replace(pinned=np.isin(np.arange(64), [21, 22]))],
    Capability.LOWER_CELLS: [
        beside("line", [[0, 1], [1, 2]]),
        beside("quad", grid(2).topology.boundary_faces[:3]),
        beside("triangle", [[0, 1, 3]]),
    ],
    Capability.VERTICES: [beside("vertex", [[0], [26]])],
    Capability.OTHER_CELLS: [
        beside("pyramid", [[18, 19, 22, 21, 27]], [[0.5, 0.5, 3]]),
        beside("tetra", [[18, 19, 21, 27]], [[0, 0, 3]]),
        beside("wedge", [[18, 27, 19, 21, 28, 22]], [[0, 0, 3], [0, 1, 3]]),
    ],
    Capability.SECOND_ORDER: [quadratic(20), quadratic(27)],
    Capability.FIELD_DATA: [grid(2).replace(field_data={"time": np.array([0.25, 8]), "title": ["made", "elsewhere"]})],
}  # fmt: skip


def same_map(a, b):
    assert set(a) <= set(b)
    for name, values in a.items():
        assert np.shape(b[name]) == np.shape(values)
        np.testing.assert_array_equal(b[name], values)


def same_sets(a, b):
    """Sets of the same names and members, in whatever order."""
    assert set(a) <= set(b)
    for name, members in a.items():
        np.testing.assert_array_equal(np.unique(b[name], axis=0), np.unique(members, axis=0))


def same_members(a, b):
    """The cells of each set are the same, in whatever order they stand."""
    assert set(a.sets) <= set(b.sets)
    for name, members in a.sets.items():
        np.testing.assert_array_equal(np.unique(b.nodes[b.sets[name]], axis=0), np.unique(a.nodes[members], axis=0))


def same_cells(a, b):
    assert [(one.kind, one.nodes.tolist()) for one in a.cells] == [(one.kind, one.nodes.tolist()) for one in b.cells]


COMPARED = {
    Capability.NODE_DATA: lambda a, b: same_map(a.node_data, b.node_data),
    Capability.HEX_DATA: lambda a, b: same_map(a.hex_data, b.hex_data),
    Capability.IDS: lambda a, b: (same_map(a.node_data, b.node_data), same_map(a.hex_data, b.hex_data)),
    Capability.NODE_SETS: lambda a, b: same_sets(a.node_sets, b.node_sets),
    Capability.HEX_SETS: lambda a, b: same_sets(a.hex_sets, b.hex_sets),
    Capability.SIDE_SETS: lambda a, b: same_sets(a.side_sets, b.side_sets),
    Capability.EMPTY_SETS: lambda a, b: (same_sets(a.hex_sets, b.hex_sets), same_sets(a.node_sets, b.node_sets)),
    Capability.CELL_SETS: lambda a, b: [same_members(*pair) for pair in zip(a.cells, b.cells, strict=True)],
    Capability.FIXED_NODES: lambda a, b: np.testing.assert_array_equal(a.fixed, b.fixed),
    Capability.LOWER_CELLS: same_cells,
    Capability.VERTICES: same_cells,
    Capability.OTHER_CELLS: same_cells,
    Capability.SECOND_ORDER: lambda a, b: np.testing.assert_array_equal(a.mid_nodes, b.mid_nodes),
    Capability.FIELD_DATA: lambda a, b: same_map(a.field_data, b.field_data),
}


def test_every_thing_that_formats_may_hold_is_tried():
    assert set(MESHES) == set(COMPARED) == set(Capability)


@pytest.mark.parametrize("thing", Capability, ids=lambda one: one.name)
@pytest.mark.parametrize(("name", "encoding"), WAYS)
def test_a_format_holds_what_it_says_and_says_what_it_does_not(name, encoding, thing, tmp_path):
    format = FORMATS[name]
    for k, mesh in enumerate(MESHES[thing]):
        path = in_new_folder(tmp_path, f"{k}{format.suffixes[0]}")
        left = io.unsupported_data(path, mesh)
        if thing not in format.capabilities:
            assert any(words.startswith(thing.value) for words in left)
            continue
        assert not any(words.startswith(thing.value) for words in left)
        try:
            io.write(path, mesh, encoding=encoding)
        except FileError as error:  # of second order some have no hexes of 27 nodes: nothing is lost unsaid
            assert "27 nodes" in str(error)
            continue
        back = io.read(path)
        np.testing.assert_array_equal(back.points, mesh.points)
        np.testing.assert_array_equal(back.hexes, mesh.hexes)
        COMPARED[thing](mesh, back)


@pytest.mark.parametrize(("name", "encoding"), WAYS)
def test_what_a_format_does_not_hold_does_not_keep_the_mesh_from_being_written(name, encoding, tmp_path):
    format = FORMATS[name]
    for thing in set(Capability) - format.capabilities:
        for k, mesh in enumerate(MESHES[thing]):
            path = in_new_folder(tmp_path, f"{thing.name}-{k}{format.suffixes[0]}")
            assert read_back(path, mesh, encoding=encoding).n_hexes == mesh.n_hexes


@pytest.mark.parametrize(("name", "format"), FORMATS.items())
def test_what_is_said_of_other_cells_is_held_or_named(name, format):
    if format.write is None:
        return
    faces = grid(2).topology.boundary_faces[:2]
    left = io.unsupported_data(
        f"a{format.suffixes[0]}", beside("quad", faces, data={"h": [1.0, 2.0]}, sets={"inlet": [0]})
    )
    assert ("cell data (h)" in left) == (Capability.HEX_DATA not in format.capabilities)
    assert ("sets of cells of lower dimension (inlet)" in left) == (Capability.CELL_SETS not in format.capabilities)
    tetra = beside("tetra", [[18, 19, 21, 27]], [[0, 0, 3]], sets={"solid": [0]})
    assert ("element sets (solid)" in io.unsupported_data(f"a{format.suffixes[0]}", tetra)) == (
        Capability.HEX_SETS not in format.capabilities
    )


@pytest.mark.parametrize("values", [np.ones((27, 3)), np.full(27, 2)], ids=["of three columns", "of no mask"])
@pytest.mark.parametrize(("name", "encoding"), WAYS)
def test_data_called_fixed_that_say_more_than_pins_are_held_or_named(name, encoding, values, tmp_path):
    path = tmp_path / f"a{FORMATS[name].suffixes[0]}"
    pinned = np.arange(27) == 13 if values.ndim > 1 else np.ones(27, bool)
    mesh = grid(2).replace(node_data={"fixed": values}, pinned=pinned)
    if Capability.NODE_DATA not in FORMATS[name].capabilities:
        assert "point data (fixed)" in io.unsupported_data(path, mesh)
        return
    back = read_back(path, mesh, encoding=encoding)
    np.testing.assert_array_equal(back.node_data["fixed"], values)
    np.testing.assert_array_equal(back.pinned, pinned)


@pytest.mark.parametrize(("name", "encoding"), WAYS)
def test_data_of_one_name_and_other_widths_are_all_kept(name, encoding, tmp_path):
    if Capability.HEX_DATA not in FORMATS[name].capabilities:
        return
    path = tmp_path / f"a{FORMATS[name].suffixes[0]}"
    mesh = beside("tetra", [[18, 19, 21, 27]], [[0, 0, 3]], data={"h": np.arange(3.0)[None]})
    back = read_back(path, mesh.replace(hex_data={"h": np.arange(8.0)}), encoding=encoding)
    np.testing.assert_array_equal(back.hex_data["h"], np.arange(8.0))
    (tetra,) = back.cells
    kept = [values for values in tetra.data.values() if np.shape(values) == (1, 3)]
    np.testing.assert_array_equal(kept, [np.arange(3.0)[None]])


@pytest.mark.parametrize(("name", "encoding"), WAYS)
def test_nodes_of_other_cells_are_fixed_where_the_user_fixes_them_alone(name, encoding, tmp_path):
    if Capability.OTHER_CELLS not in FORMATS[name].capabilities:
        return
    path = tmp_path / f"a{FORMATS[name].suffixes[0]}"
    first = beside("tetra", [[18, 19, 21, 27]], [[0, 0, 3]])
    mesh = read_back(path, first, encoding=encoding)
    assert mesh.pinned is None or not mesh.pinned.any()
    assert not any(words.startswith("fixed nodes") for words in io.unsupported_data(path, mesh))
    assert not {"fixed", "required"} & {*mesh.node_data, *mesh.node_sets}
    mesh = mesh.replace(pinned=np.isin(np.arange(28), [13, 27]))
    if Capability.FIXED_NODES not in FORMATS[name].capabilities:
        assert "fixed nodes" in io.unsupported_data(path, mesh)
        return
    np.testing.assert_array_equal(read_back(path, mesh, encoding=encoding).pinned, mesh.pinned)


def test_a_set_called_fixed_that_says_which_nodes_are_is_not_written_twice(tmp_path):
    netcdf_file = pytest.importorskip("scipy.io").netcdf_file
    members = np.array([3, 13])
    mesh = grid(2).replace(node_sets={"Fixed": members}, pinned=np.isin(np.arange(27), members))
    io.write(tmp_path / "a.exo", mesh)
    with netcdf_file(tmp_path / "a.exo", mmap=False) as file:
        assert file.dimensions["num_node_sets"] == 1
    back = io.read(tmp_path / "a.exo")
    np.testing.assert_array_equal(back.pinned, mesh.pinned)
    np.testing.assert_array_equal(back.node_sets["Fixed"], members)


@pytest.mark.parametrize("suffix", [".vtk", ".vtu", ".ovm"])
def test_data_called_as_a_set_are_one_only_if_they_are_ones_and_zeros(suffix, tmp_path):
    values = np.arange(27) / 4
    io.write(tmp_path / f"a{suffix}", grid(2).replace(node_data={"set:heat": values}, node_sets={"top": np.array([3])}))
    back = io.read(tmp_path / f"a{suffix}")
    np.testing.assert_array_equal(back.node_data["set:heat"], values)
    assert list(back.node_sets) == ["top"]
