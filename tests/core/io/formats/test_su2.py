"""SU2's files: one that Gmsh 4.15 wrote, zones, markers, and what is written and read again."""

import numpy as np

from tests.core.io.kept import read_back, read_content, with_everything

POINTS = "".join(f"{x} {y} {z}\n" for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1)))
ZONE = f"NDIME= 3\nNELEM= 1\n12 0 1 2 3 4 5 6 7 0\nNPOIN= 8 8\n{POINTS}NMARK= 1\nMARKER_TAG= low\nMARKER_ELEMS= 1\n9 0 3 2 1\n"


def read(text, tmp_path):
    return read_content(tmp_path / "a.su2", text)


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
    (quads,) = (one for one in read_back(tmp_path / "a.su2", with_everything()).cells if one.kind == "quad")
    np.testing.assert_array_equal(quads.nodes, with_everything().cells[0].nodes[[1, 3]])
    assert quads.sets["lid"].tolist() == [0, 1]
