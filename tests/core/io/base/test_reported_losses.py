"""Ids and names that a format cannot hold are reported before they are lost, and all others are kept."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend import Cells, FileError, io
from hexmend.io.base.capabilities import make_unique
from hexmend.io.base.content import Block
from hexmend.io.base.numbering import element_ids, find_ids, node_ids, runs, set_combinations
from hexmend.io.formats.exodus.netcdf3_writer import ClassicWriter
from tests.core.grids import grid
from tests.core.io.kept import read_back

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
    ".exo": (["some of 2^31 and above"], np.arange(8) + 2**31 - 8),
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
        found = getattr(read_back(path, mesh), data).get("id", np.arange(8) + 1)
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
    back = read_back(tmp_path / f"a{suffix}", mesh)
    for found in (back.cells[0].sets,) if of_cells else (back.hex_sets, back.node_sets):
        assert sorted(rows.tolist() for rows in found.values()) == [[k] for k in range(len(names))]


def test_names_that_can_be_written_are_not_changed_for_others():
    assert make_unique(["ab", "a", "ac"], lambda name, end: name[:1] + end) == {"ab": "a 2", "a": "a", "ac": "a 3"}


# Data that are not numbers, which formats leave out and say so before.


@pytest.mark.parametrize("suffix", [".vtk", ".vtu", ".exo", ".med"])
@pytest.mark.parametrize(
    "values",
    [np.array(["a"] * 8), np.arange(8) * 1j, np.array([None] * 8), np.arange(8).astype("M8[s]")],
    ids=["texts", "complex", "objects", "times"],
)
def test_data_that_are_no_numbers_are_left_out_as_announced(suffix, values, tmp_path):
    top = Cells("quad", np.array([[18, 19, 22, 21]]), {"odd": values[:1], "even": np.ones(1)})
    mesh = grid(2).replace(
        node_data={"odd": np.resize(values, 27), "t": np.arange(27.0)}, hex_data={"odd": values}, cells=(top,)
    )
    assert io.unsupported_data(tmp_path / f"a{suffix}", mesh) == [
        "point data that are not numbers (odd)",
        "cell data that are not numbers (odd)",
    ]
    back = read_back(tmp_path / f"a{suffix}", mesh)
    assert "odd" not in {*back.node_data, *back.hex_data, *back.cells[0].data}
    np.testing.assert_array_equal(back.node_data["t"], np.arange(27))
    assert back.cells[0].data["even"].tolist() == [1]


# Whole numbers at the ends of what 32 bits hold are kept exactly by ExodusII's classic container; ids of 2^63 by none.


@pytest.mark.parametrize("length", [5, 31, 32, 33, 80])
def test_every_text_ends_with_a_zero_byte_as_programs_in_c_expect(length, tmp_path):
    from scipy.io import netcdf_file

    writer = ClassicWriter({})
    writer.add_strings("names", "n", ["a" * length, "b"])
    writer.write(tmp_path / "a.nc")
    with netcdf_file(tmp_path / "a.nc", mmap=False) as file:
        letters = file.variables["names"]
        assert letters.shape == (2, max(33, length + 1))
        assert b"".join(letters[0]) == b"a" * length  # of zero bytes NumPy makes nothing


@pytest.mark.parametrize("where", ["hexes", "quads", "both", "neither"])
def test_there_is_a_time_step_where_any_block_has_results(where, tmp_path):
    from scipy.io import netcdf_file

    mesh = grid(2)
    quads = Cells("quad", mesh.hexes[:1, 4:], {"t": np.array([2.0])} if where in ("quads", "both") else {})
    mesh = mesh.replace(cells=(quads,), hex_data={"u": np.arange(8.0)} if where in ("hexes", "both") else {})
    io.write(tmp_path / "a.exo", mesh)
    with netcdf_file(tmp_path / "a.exo", mmap=False) as file:
        assert file.variables["time_whole"].shape == ((1,) if where != "neither" else (0,))
    assert list(io.read(tmp_path / "a.exo").hex_data) == (["u"] if where in ("hexes", "both") else [])


# Labels and types in the forms that callers may give them.


WORDS = ["inlet", "", "Ωall & <more>"]


@pytest.mark.parametrize("form", [list, tuple, np.array])
def test_texts_are_written_to_vtu_whatever_holds_them(form, tmp_path):
    mesh = grid(2).replace(field_data={"words": form(WORDS), "one": form(WORDS[2:])})
    back = read_back(tmp_path / "a.vtu", mesh).field_data
    assert list(np.atleast_1d(back["words"])) == WORDS
    assert list(np.atleast_1d(back["one"])) == WORDS[2:]


# Numbers of a file: found again wherever they stand, kept where they can be.


numbers = st.lists(st.integers(-(10**9), 10**9), min_size=1, max_size=20, unique=True)


@given(ids=numbers, data=st.data())
def test_places_are_where_the_numbers_stand(ids, data):
    wanted = np.array(data.draw(st.lists(st.sampled_from(ids), min_size=1)))
    assert (np.array(ids)[find_ids(Path("a"), np.array(ids), wanted, "node")] == wanted).all()


@pytest.mark.parametrize(
    ("ids", "words"), [([1, 2, 3], "node 9 is used"), ([4, 9, 4], "node 4 is given twice"), ([], "node 9 is used")]
)
def test_numbers_that_are_not_there_or_twice_are_named(ids, words):
    with pytest.raises(FileError, match=words):
        find_ids(Path("a"), np.array(ids, dtype=np.int64), np.array([9]), "node")


@pytest.mark.parametrize("ids", [[3, 3, 1], [0, 1, 2], [-1, 1, 2], [1, 2, 2**31], [0.5, 1.0, 2.0]])
def test_numbers_that_no_file_can_have_are_replaced(ids):
    assert node_ids({"id": np.array(ids)}, 3).tolist() == [1, 2, 3]


def test_elements_without_numbers_come_after_those_with_them():
    hexes = Block("hex", np.zeros((2, 8), int), {"id": np.array([9, 5])})
    quads = Block("quad", np.zeros((2, 4), int))
    assert [one.tolist() for one in element_ids([hexes, quads])] == [[9, 5], [10, 11]]
    assert [one.tolist() for one in element_ids([hexes, hexes])] == [[1, 2], [3, 4]]


@given(key=st.lists(st.integers(0, 2)))
def test_runs_go_through_all_in_order_and_are_each_of_one_kind(key):
    found = runs(np.array(key, dtype=np.int64))
    assert [value for part in found for value in key[part]] == key
    assert all(len(set(key[part])) == 1 for part in found)


@given(sets=st.dictionaries(st.sampled_from("abc"), st.sets(st.integers(0, 5))))
def test_combinations_are_the_sets_that_each_is_in(sets):
    found, which = set_combinations(
        {name: np.array(sorted(members), dtype=np.int64) for name, members in sets.items()}, 6
    )
    for k in range(6):
        assert set(found[which[k]]) == {name for name, members in sets.items() if k in members}
