"""MED files: written by Gmsh 4.15 and MEDCoupling 9.15, and written and read again."""

from pathlib import Path

import numpy as np
import pytest

from hexmend import io
from hexmend.errors import FileError
from hexmend.mesh.cells import Cells
from tests.core.grids import grid
from tests.core.io.kept import with_everything

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
        (lambda file, step: step["MAI/HE8/NOD"].__setitem__(3, 99), "HE8/NOD refers to node 99: expected 1 to 15"),
        (huge, "declares more data than a file of its size can hold"),
        (lambda file, step: file["ENS_MAA/m"].attrs.__setitem__("ESP", 2), "is not in space"),
        (lambda file, step: file["ENS_MAA/m"].attrs.__setitem__("TYP", 1), "is structured"),
    ],
)
def test_errors_name_the_problem(change, words, tmp_path):
    with pytest.raises(FileError) as error:
        io.read(changed(tmp_path, change))
    assert words in str(error.value)


def test_each_group_and_array_has_the_attributes_that_the_library_writes(tmp_path):
    """Steps, sizes and "no step" as in files of the MED library."""
    h5py = pytest.importorskip("h5py")
    mesh = with_everything()
    io.write(tmp_path / "a.med", mesh)
    with h5py.File(tmp_path / "a.med") as file:

        def numbers(group):
            return {name: int(value) for name, value in group.attrs.items() if np.asarray(value).dtype.kind == "i"}

        assert numbers(file["INFOS_GENERALES"]) == {"MAJ": 4, "MIN": 1, "REL": 0}
        (title,) = file["ENS_MAA"]
        about = file["ENS_MAA"][title]
        assert numbers(about) == {"DIM": 3, "ESP": 3, "NXI": -1, "NXT": -1, "REP": 0, "SRT": 0, "TYP": 0}
        (step,) = about.values()
        assert step.name.endswith(f"{-1:020d}{-1:020d}")
        none = dict.fromkeys(["NDT", "NOR", "NXI", "NXT", "PVI", "PVT"], -1)
        assert numbers(step) == {"CGT": 1} | none
        assert step.attrs["PDT"] == -1.0
        for group in (step["NOE"], *step["MAI"].values()):
            assert group.attrs["PFL"] == b"MED_NO_PROFILE_INTERNAL"
        assert numbers(step["NOE"]) == {"CGT": 1, "CGS": 1}
        for name, values in step["NOE"].items():
            assert numbers(values) == {"CGT": 1, "NBR": mesh.n_nodes}, name
        assert numbers(step["MAI"]) == {"CGT": 1}
        for cells in step["MAI"].values():
            assert numbers(cells).keys() == {"CGT", "CGS", "GEO"}
            assert (cells.attrs["CGT"], cells.attrs["CGS"]) == (1, 1)
            count = len(cells["FAM"])
            assert all(numbers(values) == {"CGT": 1, "NBR": count} for values in cells.values())
        families = file["FAS"][title]
        assert numbers(families["FAMILLE_ZERO"]) == {"NUM": 0}
        for place, sign in (("NOEUD", 1), ("ELEME", -1)):
            own = [int(family.attrs["NUM"]) for family in families[place].values()]
            assert sorted(sign * number for number in own) == list(range(1, len(own) + 1))


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
