"""Ids that a MED file cannot hold are reported."""

import numpy as np
import pytest

from hexmend import io
from tests.core.grids import grid


@pytest.mark.parametrize("where", ["node_data", "hex_data"])
@pytest.mark.parametrize("whole", [True, False])
def test_ids_other_than_whole_numbers_are_left_out_and_reported(where, whole, tmp_path):
    mesh = grid(2)
    count = mesh.n_nodes if where == "node_data" else mesh.n_hexes
    mesh = mesh.replace(**{where: {"id": np.arange(1, count + 1) + (0 if whole else 0.5)}})
    sort = "nodes" if where == "node_data" else "elements"
    assert io.unsupported_data(tmp_path / "a.med", mesh) == ([] if whole else [f"ids of {sort} (no whole numbers)"])


def test_the_header_states_med_4_1_and_an_unstructured_mesh_of_three_dimensions(tmp_path):
    """The values are those that the MED library writes."""
    import h5py

    io.write(tmp_path / "a.med", grid(2))
    with h5py.File(tmp_path / "a.med") as file:
        said = file["INFOS_GENERALES"].attrs
        assert [said[name] for name in ("MAJ", "MIN", "REL")] == [4, 1, 0]
        (mesh,) = file["ENS_MAA"].values()
        kind = {"DIM": 3, "ESP": 3, "REP": 0, "SRT": 0, "TYP": 0, "NXI": -1, "NXT": -1}
        assert {name: int(mesh.attrs[name]) for name in kind} == kind
        (step,) = mesh.values()
        assert {name: int(step.attrs[name]) for name in ("CGT", "NDT", "NOR")} == {"CGT": 1, "NDT": -1, "NOR": -1}
        assert (step["NOE"].attrs["CGT"], step["MAI"].attrs["CGT"]) == (1, 1)
