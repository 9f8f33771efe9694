"""Reading Gmsh's format of version 1."""

from hexmend import io, summarise

FIRST_VERSION = """\
$NOD
9
10 0 0 0
20 1 0 0
30 1 1 0
40 0 1 0
50 0 0 1
60 1 0 1
70 1 1 1
80 0 1 1
90 0 0 2
$ENDNOD
$ELM
3
4 3 1 6 4 10 20 30 40
5 4 0 9 4 50 60 80 90
7 5 100 1000 8 10 20 30 40 50 60 70 80
$ENDELM
"""


def test_the_first_version_of_the_format_is_read(tmp_path):
    (tmp_path / "a.msh").write_text(FIRST_VERSION)
    (tmp_path / "b.txt").write_text(FIRST_VERSION)  # recognised by its content
    for name in ("a.msh", "b.txt"):
        mesh = io.read(tmp_path / name)
        assert mesh.hexes.tolist() == [list(range(8))]
        assert mesh.node_data["id"].tolist() == list(range(10, 100, 10))
        assert mesh.hex_data["id"].tolist() == [7]
        assert mesh.hex_sets["physical 100"].tolist() == [0]
        assert {one.kind: dict(one.sets) for one in mesh.cells} == {"quad": {"physical 1": [0]}, "tetra": {}}
        assert summarise(mesh).inverted == 0
