"""MED files: written by Gmsh 4.15 and MEDCoupling 9.15, and written and read again."""

from pathlib import Path

import numpy as np
import pytest

from hexmend import Cells, io
from tests.core.grids import grid
from tests.core.io.kept import assert_refused

FILES = Path(__file__).parents[2] / "files"


def changed(tmp_path, change):
    h5py = pytest.importorskip("h5py")
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


@pytest.mark.parametrize(
    ("change", "words"),
    [
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
    ],
)
def test_errors_name_the_problem(change, words, tmp_path):
    assert_refused(changed(tmp_path, change), words)


def whole_numbers(path):
    """The whole-number attributes of all groups and arrays of the mesh, and the numbers of its families."""
    h5py, found = pytest.importorskip("h5py"), {}
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
