"""Ids and names that a format cannot hold are reported before they are lost, and all others are kept."""

import numpy as np
import pytest

from hexmend import Cells, io
from hexmend.io.base.capabilities import make_unique
from tests.core.grids import grid

IDS = {
    "some below 1": np.arange(8),
    "some given twice": np.array([1, 2, 3, 4, 5, 6, 7, 7]),
    "no whole numbers": np.arange(8) + 1.5,
    "some of 100,000,000 and above": np.arange(8) + 10**8 - 7,
    "some of 2^31 and above": np.arange(8) + 2**31 - 7,
    "some of 2^63 and above": np.arange(8).astype(np.uint64) + np.uint64(2**63 - 7),
}
SMALL = ["some below 1", "some given twice", "no whole numbers"]
#: Reasons for which a format refuses ids, and ids that it keeps.
FORMATS = {
    ".inp": ([*SMALL, "some of 2^31 and above"], np.arange(8) + 2**31 - 8),
    ".msh": ([*SMALL, "some of 2^31 and above"], np.arange(8) * 5 + 3),
    ".bdf": ([*SMALL, "some of 100,000,000 and above"], np.arange(8) + 10**8 - 8),
    ".med": (["no whole numbers", "some of 2^63 and above"], np.arange(8).astype(np.uint64) + np.uint64(2**63 - 8)),
    ".exo": (["some of 2^63 and above"], np.arange(8).astype(np.uint64) + np.uint64(2**63 - 8)),
}


@pytest.mark.parametrize(("suffix", "why"), [(s, why) for s, (reasons, _) in FORMATS.items() for why in [*reasons, ""]])
def test_ids_are_kept_or_the_reason_is_said(suffix, why, tmp_path):
    ids = IDS[why] if why else FORMATS[suffix][1]
    row, cube = grid(8, 1, 1), grid(1)
    of_nodes = cube.replace(node_data={"id": ids}, hex_data={"id": np.array([4])})
    of_hexes = row.replace(node_data={"id": np.arange(row.n_nodes) + 50}, hex_data={"id": ids})
    for mesh, data, label in ((of_nodes, "node_data", "nodes"), (of_hexes, "hex_data", "elements")):
        path = tmp_path / f"{label}{suffix}"
        assert io.unsupported_data(path, mesh) == ([f"ids of {label} ({why})"] if why else [])
        io.write(path, mesh)
        found = getattr(io.read(path), data).get("id", np.arange(8) + 1)
        np.testing.assert_array_equal(found, np.arange(8) + 1 if why else ids)


LONG = "é" * 45
ALIKE = [
    (".med", [LONG + "1", LONG + "2", "a" * 80 + "b", "a" * 80]),
    (".med", ["wall", "wall "]),
    (".inp", ['x"y', "x'y"]),
    (".inp", ["wall", " WALL "]),
    (".inp", ["a b", "a  b"]),
    (".inp", ["wall", "Wall", 'a "b", c']),
    (".exo", [" lead", "lead", "S", "s", ""]),
    (".msh", ["a b", "a  b", " a b"]),
    (".msh", [" ", "unnamed"]),
    (".su2", ["a b", "a_b", "a%b"]),
    (".su2", ["in", "in %", "in\t"]),
]


@pytest.mark.parametrize(("suffix", "names"), ALIKE)
def test_sets_of_like_names_stay_apart(suffix, names, tmp_path):
    mesh, sets = grid(len(names), 1, 1), {name: np.array([k]) for k, name in enumerate(names)}
    quads = mesh.topology.boundary_faces[: len(names)]
    of_cells = suffix in (".msh", ".su2")
    held = {"cells": (Cells("quad", quads, {}, sets),)} if of_cells else {"hex_sets": sets, "node_sets": sets}
    mesh = mesh.replace(**held)
    assert any(part.startswith("names of sets as they are") for part in io.unsupported_data(f"a{suffix}", mesh))
    io.write(tmp_path / f"a{suffix}", mesh)
    back = io.read(tmp_path / f"a{suffix}")
    for found in (back.cells[0].sets,) if of_cells else (back.hex_sets, back.node_sets):
        assert sorted(rows.tolist() for rows in found.values()) == [[k] for k in range(len(names))]


def test_names_that_can_be_written_are_not_changed_for_others():
    assert make_unique(["ab", "a", "ac"], lambda name, end: name[:1] + end) == {"ab": "a 2", "a": "a", "ac": "a 3"}
