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
