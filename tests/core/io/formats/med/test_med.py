"""MED files: written by Gmsh 4.15 and MEDCoupling 9.15, and written and read again."""

from pathlib import Path

import numpy as np
import pytest

from hexmend import Cells, FileError, io
from tests.core.grids import grid
from tests.core.io.kept import assert_refused

h5py = pytest.importorskip("h5py")
FILES = Path(__file__).parents[2] / "files"
FILE = FILES / "medcoupling-fields.med"


def test_fields_of_medcoupling_are_read_as_data():
    mesh = io.read(FILE)
    np.testing.assert_array_equal(mesh.node_data["temp"], np.arange(12))
    np.testing.assert_array_equal(mesh.node_data["velo"][5], [5, 5.5, -5])
    np.testing.assert_array_equal(mesh.hex_data["stress"], [np.arange(1, 7), np.arange(11, 17)])
    np.testing.assert_array_equal(mesh.hex_data["ints"], [5, 6])
    np.testing.assert_array_equal(mesh.hex_data["part"], [np.nan, 99])  # of one hex only
    np.testing.assert_array_equal(mesh.hex_data["press"], [17, 18])  # of two steps the last
    assert mesh.notes == (
        "Not read: fields at Gauss points, or at the nodes of each element (elno).",
        "Not read: all time steps but the last of fields (press).",
    )


def attributes(path, field):
    """Attributes of a field and its groups by depth, without times and names of components."""
    with h5py.File(path) as file:
        groups, found = [file["CHA"][field]], []
        while groups and isinstance(groups[0], h5py.Group):
            found.append({name: value for one in groups for name, value in one.attrs.items()})
            groups = [inner for one in groups for inner in one.values()]
    passing = {"MAI", "NDT", "NOR", "PDT", "NOM", "UNI", "UNT"}
    return [{name: value for name, value in one.items() if name not in passing} for one in found]


@pytest.mark.parametrize("field", ["temp", "velo", "stress", "ints"])
def test_a_field_has_the_attributes_that_the_library_writes(field, tmp_path):
    io.write(tmp_path / "a.med", io.read(FILE))
    assert attributes(tmp_path / "a.med", field) == attributes(FILE, field)


def test_data_of_nodes_and_cells_with_one_name_and_type_become_one_field(tmp_path):
    mesh = grid(2).replace(node_data={"both": np.arange(27.0), "many": np.arange(54.0).reshape(27, 2)})
    quads = Cells("quad", grid(2).topology.boundary_faces[:2], {"both": np.ones(2), "many": np.array([2**40, 3])})
    mesh = mesh.replace(hex_data={"both": np.arange(8) / 2}, cells=(quads,))
    io.write(tmp_path / "a.med", mesh)
    with h5py.File(tmp_path / "a.med") as file:
        assert list(file["CHA"]) == ["both", "many", "many_2"]
        (step,) = file["CHA/both"].values()
        assert set(step) == {"NOE", "MAI.HE8", "MAI.QU4"}
        assert step.attrs["LGC"] == 1 << 13 | 1 << 5
    back = io.read(tmp_path / "a.med")
    for name, values in mesh.node_data.items():
        np.testing.assert_array_equal(back.node_data[name], values)
    np.testing.assert_array_equal(back.hex_data["both"], np.arange(8) / 2)
    assert back.cells[0].data["many_2"].tolist() == [2**40, 3]


def test_unsupported_names_and_values_are_reported(tmp_path):
    names = ["a/b", "a_b", ".", "é" * 40 + "1", "é" * 40 + "2"]
    data = {name: np.full(8, k) for k, name in enumerate(names)}
    mesh = grid(1).replace(node_data={**data, "words": np.array(["x"] * 8)})
    said = io.unsupported_data(tmp_path / "a.med", mesh)
    assert said[0] == "point data that are not numbers (words)"
    assert said[1].startswith("names of data as they are (., a/b, ")
    io.write(tmp_path / "a.med", mesh)
    back = io.read(tmp_path / "a.med").node_data
    assert sorted(values.tolist() for values in back.values()) == [[k] * 8 for k in range(5)]
    assert back["a_b"][0] == 1


def changed(tmp_path, change):
    path = tmp_path / "a.med"
    path.write_bytes(FILE.read_bytes())
    with h5py.File(path, "a") as file:
        change(file, next(iter(file["CHA/temp"].values()))["NOE/MED_NO_PROFILE_INTERNAL"])
    return path


def shorter(file, part):
    values = part["CO"][:-1]
    del part["CO"]
    part["CO"] = values


def wrong_profile(file, part):
    file["PROFILS/pfl1/PFL"][0] = 3


ERRORS = [
    (shorter, "CO holds 11 numbers: expected 1 for each of 12"),
    (lambda file, part: part.__delitem__("CO"), "has no CO"),
    (wrong_profile, "the profile pfl1 refers to the entries 3 to 3: expected 1 to 2"),
    (lambda file, part: file["CHA/temp"].attrs.__setitem__("NCO", 0), "the field temp has 0 components"),
    (lambda file, part: file["PROFILS"].__delitem__("pfl1"), "cannot be read as HDF5"),
]


@pytest.mark.parametrize(("change", "words"), ERRORS)
def test_errors_name_the_problem(change, words, tmp_path):
    assert_refused(changed(tmp_path, change), words)


def test_fields_of_other_meshes_are_left_out_with_a_note(tmp_path):
    path = changed(tmp_path, lambda file, part: file["CHA/temp"].attrs.__setitem__("MAI", np.bytes_("other")))
    mesh = io.read(path)
    assert "temp" not in mesh.node_data
    assert "Not read: fields of other meshes (temp)." in mesh.notes


@pytest.mark.parametrize("profiles", [0, 1])
def test_a_field_of_far_more_components_than_the_file_has_is_refused(profiles, tmp_path):
    """Values of a single node, which would need an array for all nodes."""
    width = 100_000
    io.write(tmp_path / "a.med", grid(10).replace(node_data={"a": np.zeros(1331)}))
    with h5py.File(tmp_path / "a.med", "r+") as file:
        file["CHA/a"].attrs["NCO"] = np.int32(width)
        (step,) = file["CHA/a"].values()
        del step["NOE/MED_NO_PROFILE_INTERNAL"]
        if profiles:
            step["NOE"].create_group("one").attrs["NGA"] = np.int32(1)
            step["NOE/one/CO"] = np.zeros(width)
            file["PROFILS/one/PFL"] = np.array([1], "<i4")
    with pytest.raises(FileError, match=r"the field a .* too many for a file"):
        io.read(tmp_path / "a.med")


def changed_mesh(tmp_path, change):
    path = tmp_path / "a.med"
    path.write_bytes((FILES / "gmsh-o1.med").read_bytes())
    with h5py.File(path, "a") as file:
        step = file["ENS_MAA/m"][next(iter(file["ENS_MAA/m"]))]
        change(file, step)
    return path


def cut_connectivity(file, step):
    rows = step["MAI/HE8/NOD"][:-1]
    del step["MAI/HE8/NOD"]
    step["MAI/HE8/NOD"] = rows


def huge(file, step):
    del step["NOE/COO"]
    step["NOE"].create_dataset("COO", (3 * 10**11,), "f8", chunks=(1000,))


ERRORS_IN_MESHES = [
    (lambda file, step: file.__delitem__("ENS_MAA"), "holds no mesh"),
    (lambda file, step: step.__delitem__("NOE"), "has no nodes"),
    (lambda file, step: step.__delitem__("MAI/HE8/NOD"), "MAI/HE8 has no NOD"),
    (cut_connectivity, "HE8/NOD holds 15 numbers: expected 8 a cell"),
    (
        lambda file, step: step["MAI/HE8/NOD"].__setitem__(3, 99),
        "HE8/NOD refers to the nodes 1 to 99: expected 1 to 15",
    ),
    (huge, "more than a file of its size holds"),
    (lambda file, step: file["ENS_MAA/m"].attrs.__setitem__("ESP", 2), "is not in space"),
    (lambda file, step: file["ENS_MAA/m"].attrs.__setitem__("TYP", 1), "is structured"),
]


@pytest.mark.parametrize(("change", "words"), ERRORS_IN_MESHES)
def test_errors_in_meshes_are_named(change, words, tmp_path):
    assert_refused(changed_mesh(tmp_path, change), words)


def whole_numbers(path):
    """The whole-number attributes of all groups and arrays of the mesh, and the numbers of its families."""
    found = {}
    with h5py.File(path) as file:
        (mesh,) = file["ENS_MAA"].values()
        (families,) = file["FAS"].values()
        mesh.visititems(
            lambda name, one: found.update(
                {(name, key): int(value) for key, value in one.attrs.items() if np.asarray(value).dtype.kind == "i"}
            )
        )
        found |= {key: value for key, value in mesh.attrs.items() if np.asarray(value).dtype.kind == "i"}
        return found, sorted(int(one.attrs["NUM"]) for one in families["ELEME"].values())


def test_each_group_and_array_has_the_attributes_that_the_library_writes(tmp_path):
    given = FILES / "medcoupling-o2i.med"
    io.write(tmp_path / "a.med", io.read(given).replace(node_sets={"some": np.array([0])}))
    theirs, ours = whole_numbers(given), whole_numbers(tmp_path / "a.med")
    assert ours == theirs


def test_cells_of_one_kind_in_several_blocks_keep_their_sets(tmp_path):
    mesh = grid(2)
    quads = mesh.topology.boundary_faces
    mesh = mesh.replace(
        cells=(
            Cells("quad", quads[:3], sets={"floor": np.array([0, 2])}),
            Cells("quad", quads[3:8], sets={"floor": np.array([1]), "wall": np.array([4])}),
        )
    )
    io.write(tmp_path / "a.med", mesh)
    (back,) = (one for one in io.read(tmp_path / "a.med").cells if one.kind == "quad")
    np.testing.assert_array_equal(back.nodes, quads[:8])
    assert {name: members.tolist() for name, members in back.sets.items()} == {"floor": [0, 2, 4], "wall": [7]}
