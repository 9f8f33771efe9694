"""Names of sets that a file cannot have: written as others, none of which are alike, and that is said."""

import numpy as np
import pytest

from hexmend import io
from hexmend.io.base.unique_names import make_unique
from hexmend.mesh.cells import Cells
from tests.core.grids import grid

LONG = "é" * 45


def test_names_that_can_be_written_are_not_changed_for_others():
    assert make_unique(["ab", "a", "ac"], lambda name, end: name[:1] + end) == {"ab": "a 2", "a": "a", "ac": "a 3"}


@pytest.mark.parametrize(
    ("suffix", "names"),
    [
        (".med", [LONG + "1", LONG + "2", "a" * 80 + "b", "a" * 80]),
        (".med", ["wall", "wall "]),
        (".inp", ['x"y', "x'y"]),
        (".inp", ["wall", " WALL "]),
        (".inp", ["a b", "a  b"]),
    ],
)
def test_sets_of_like_names_stay_apart(suffix, names, tmp_path):
    mesh = grid(len(names), 1, 1)
    sets = {name: np.array([k]) for k, name in enumerate(names)}
    mesh = mesh.replace(hex_sets=sets, node_sets=sets)
    (said,) = io.unsupported_data(tmp_path / f"a{suffix}", mesh)
    assert said.startswith("names of sets as they are")
    io.write(tmp_path / f"a{suffix}", mesh)
    back = io.read(tmp_path / f"a{suffix}")
    for found in (back.hex_sets, back.node_sets):
        assert sorted(rows.tolist() for rows in found.values()) == [[k] for k in range(len(names))]


@pytest.mark.parametrize(
    ("suffix", "names"),
    [
        (".msh", ["a b", "a  b", " a b"]),
        (".msh", [" ", "unnamed"]),
        (".su2", ["a b", "a_b", "a%b"]),
        (".su2", ["in", "in %", "in\t"]),
    ],
)
def test_groups_and_markers_of_like_names_stay_apart(suffix, names, tmp_path):
    mesh = grid(2)
    quads = mesh.topology.boundary_faces[: len(names)]
    mesh = mesh.replace(cells=(Cells("quad", quads, {}, {name: np.array([k]) for k, name in enumerate(names)}),))
    assert any(
        said.startswith("names of sets as they are") for said in io.unsupported_data(tmp_path / f"a{suffix}", mesh)
    )
    io.write(tmp_path / f"a{suffix}", mesh)
    (back,) = io.read(tmp_path / f"a{suffix}").cells
    members = [back.nodes[rows].tolist() for rows in back.sets.values()]
    assert sorted(members) == sorted([row.tolist()] for row in quads)
