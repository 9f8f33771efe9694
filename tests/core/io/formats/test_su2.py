"""SU2's files: one that Gmsh 4.15 wrote, zones, markers, and what is written and read again."""

import numpy as np
import pytest

from hexmend import io
from hexmend.errors import FileError
from tests.core.io.kept import with_everything

POINTS = "".join(f"{x} {y} {z}\n" for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1)))
ZONE = f"NDIME= 3\nNELEM= 1\n12 0 1 2 3 4 5 6 7 0\nNPOIN= 8 8\n{POINTS}NMARK= 1\nMARKER_TAG= low\nMARKER_ELEMS= 1\n9 0 3 2 1\n"


def read(text, tmp_path):
    (tmp_path / "a.su2").write_text(text)
    return io.read(tmp_path / "a.su2")


def test_all_zones_are_read_each_with_its_own_nodes(tmp_path):
    second = ZONE.replace("low", "high").replace("0 0 0\n", "0.5 0 0\n")
    mesh = read(f"% two\nNZONE= 2\nIZONE= 1\n{ZONE}IZONE= 2\n{second}", tmp_path)
    assert mesh.hexes.tolist() == [list(range(8)), list(range(8, 16))]
    assert {name: members.tolist() for name, members in mesh.hex_sets.items()} == {"zone 1": [0], "zone 2": [1]}
    assert mesh.cells[0].nodes.tolist() == [[0, 3, 2, 1], [8, 11, 10, 9]]
    assert {name: members.tolist() for name, members in mesh.cells[0].sets.items()} == {"low": [0], "high": [1]}
    assert mesh.points[8].tolist() == [0.5, 0, 0]
    assert "2 zones" in mesh.notes[0]


def test_markers_are_written(tmp_path):
    io.write(tmp_path / "a.su2", with_everything())
    (quads,) = (one for one in io.read(tmp_path / "a.su2").cells if one.kind == "quad")
    np.testing.assert_array_equal(quads.nodes, with_everything().cells[0].nodes[[1, 3]])
    assert quads.sets["lid"].tolist() == [0, 1]


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("NDIME= 3", "\0", "holds bytes that are not text"),
        ("NDIME= 3", "NDIME= 2", "NDIME is '2': expected 3"),
        ("NELEM= 1", "NELEM= 99999999999", "NELEM holds 10 numbers, which are not 99999999999 elements"),
        ("12 0", "29 0", "NELEM holds 10 numbers, which are not 1 elements of the types"),
        ("NPOIN= 8 8", "NPOIN= 9", "NPOIN holds 24 numbers: expected 3 or 4 for each of 9 nodes"),
        ("6 7 0\n", "6 8 0\n", "refers to node 8: expected numbers from 0 to 7"),
        ("1 0 0\n", "1 x 0\n", "NPOIN holds 'x'"),
        ("NDIME= 3", "NZONE= 2\nNDIME= 3", "holds 1 zones: expected 2"),
        (ZONE, "NDIME= 3\n", "has neither NELEM= nor NPOIN="),
        ("NPOIN= 8 8\n" + POINTS, "", "zone 1 has no NPOIN="),
    ],
)
def test_what_is_wrong_is_named(old, new, words, tmp_path):
    assert old in ZONE
    with pytest.raises(FileError) as error:
        read(ZONE.replace(old, new), tmp_path)
    assert words in str(error.value)
