"""LS-DYNA's keyword files: written by hand in every layout of columns, and written and read again."""

import numpy as np
import pytest

from hexmend import FileError, io
from hexmend.doctor import examine
from hexmend.io import Original, write_as_given
from hexmend.mesh.hexahedron import FACES, UNIT_CUBE
from tests.core.grids import displaced
from tests.core.io.kept import read_back, read_content, with_everything

NODES = "".join(f"{k:8d}{x:16.6f}{y:16.6f}{z:16.6f}       0\n" for k, (x, y, z) in enumerate(UNIT_CUBE, 11))
HEX = "       5       3" + "".join(f"{k:8d}" for k in range(11, 19)) + "\n"
DECK = f"*KEYWORD\n*TITLE\na cube\n*NODE\n$#   nid\n{NODES}*ELEMENT_SOLID\n$ eid pid\n{HEX}*END\n*NODE\nnot read\n"


def read(text, tmp_path):
    return read_content(tmp_path / "a.k", text)


LAYOUTS = {
    "standard": DECK,
    "without *KEYWORD": DECK.split("\n", 3)[3],
    "between commas": DECK.replace(NODES, "".join(",".join(line.split()) + "\n" for line in NODES.splitlines())),
    "two lines an element": DECK.replace(HEX, HEX[:16] + "\n" + HEX[16:]),
    "with directions": DECK.replace("SOLID\n", "SOLID_ORTHO\n").replace(HEX, HEX + "     1.0\n" * 2),
    "thick shell": DECK.replace("SOLID", "TSHELL"),
    "wide ids": DECK.replace("*KEYWORD", "*KEYWORD I10=Y")
    .replace(NODES, "".join(f"{line[:8]:>10}{line[8:56]}\n" for line in NODES.splitlines()))
    .replace(HEX, "".join(f"{number:>10}" for number in HEX.split()) + "\n"),
    "long": DECK.replace("*KEYWORD", "*KEYWORD LONG=Y")
    .replace(NODES, "".join("".join(f"{word:>20}" for word in line.split()[:4]) + "\n" for line in NODES.splitlines()))
    .replace(HEX, "".join(f"{number:>20}" for number in HEX.split()) + "\n"),
    "line ends of Windows": DECK.replace("\n", "\r\n"),
}


@pytest.mark.parametrize("name", LAYOUTS)
def test_every_layout_is_read_and_all_but_the_coordinates_kept(name, tmp_path):
    mesh = read(LAYOUTS[name], tmp_path)
    np.testing.assert_array_equal(mesh.points, UNIT_CUBE)
    assert mesh.hexes.tolist() == [list(range(8))]
    assert (mesh.node_data["id"].tolist(), mesh.hex_data["id"].tolist()) == (list(range(11, 19)), [5])
    moved = displaced(mesh, [2, 7], [0.125, 0.25, 1 / 3])
    assert write_as_given(tmp_path / "b.k", moved, Original(tmp_path / "a.k", mesh)).replaced
    np.testing.assert_allclose(io.read(tmp_path / "b.k").points, moved.points, rtol=1e-9)
    given, new = ((tmp_path / one).read_bytes().split(b"\n") for one in ("a.k", "b.k"))
    assert sum(a != b for a, b in zip(given, new, strict=True)) == 2


def test_solids_that_repeat_nodes_are_tetrahedra_pyramids_and_wedges(tmp_path):
    apex = NODES + "".join(
        f"{k:8d}{x:16.6f}{y:16.6f}{2.0:16.6f}\n" for k, (x, y) in enumerate([(0, 0.5), (1, 0.5)], 19)
    )
    rows = ["6 1 15 16 17 18 19 19 19 19", "7 1 15 16 17 19 19 19 19 19", "8 1 15 16 17 18 19 19 20 20"]
    solids = "".join("".join(f"{int(word):8d}" for word in row.split()) + "\n" for row in rows)
    mesh = read(DECK.replace(NODES, apex).replace(HEX, HEX + solids), tmp_path)
    cells = {cells.kind: (cells.nodes + 11).tolist() for cells in mesh.cells}
    assert cells["pyramid"] == [[15, 16, 17, 18, 19]]
    assert cells["tetra"] == [[15, 16, 17, 19]]
    assert cells["wedge"] == [[15, 19, 16, 18, 20, 17]]


def test_parts_and_sets_are_sets(tmp_path):
    second = "".join(f"{k + 10:8d}{x:16.6f}{y:16.6f}{z + 1:16.6f}\n" for k, (x, y, z) in enumerate(UNIT_CUBE, 11))
    more = "       6       4" + "".join(f"{k:8d}" for k in range(21, 29)) + "\n"
    sets = "*PART\nwheel\n         4\nrim\n         3         1\n*SET_NODE_LIST_TITLE\nbase nodes\n         1\n"
    sets += "        11        12\n        99\n*SET_NODE_LIST_GENERATE\n         2\n        21        24\n"
    sets += "*SET_SOLID\n         3\n         6\n*SET_SEGMENT\n         4\n        11        14        13        12\n"
    sets += "*ELEMENT_DISCRETE\n       9       5      14\n*CONTACT_TIED\n         1\n"
    deck = DECK.replace(NODES, NODES + second).replace(HEX, HEX + more).replace("*END", sets + "*END", 1)
    mesh = read(deck, tmp_path)
    assert {name: rows.tolist() for name, rows in mesh.hex_sets.items()} == {
        "rim": [0],
        "wheel": [1],
        "solid set 3": [1],
    }
    assert {name: rows.tolist() for name, rows in mesh.node_sets.items()} == {
        "base nodes": [0, 1], "node set 2": [8, 9, 10, 11],
    }  # fmt: skip
    ((hexa, face),) = mesh.side_sets["segment set 4"]
    assert (hexa, sorted(FACES[face])) == (0, [0, 1, 2, 3])
    assert mesh.pinned.tolist() == [k == 3 for k in range(16)]
    assert {finding.kind for finding in examine(mesh)} == {"parts"}  # in contact, with nodes at one place
    assert "other cards (1 *ELEMENT_DISCRETE, 1 *CONTACT_TIED)" in mesh.notes[0]


def test_files_of_a_deck_are_read_and_replaced_under_a_new_name(tmp_path):
    (tmp_path / "sub").mkdir()
    (tmp_path / "sub/nodes.k").write_text(f"*NODE\n{NODES}*END\n")
    deck = DECK.replace(f"*NODE\n$#   nid\n{NODES}", "*INCLUDE\nsub/ +\nnodes.k\n*INCLUDE\nhex.k\n").replace(HEX, "")
    (tmp_path / "hex.k").write_text(f"*ELEMENT_SOLID\n{HEX}")
    mesh = read(deck, tmp_path)
    moved = displaced(mesh, [2], [0.25, 0, 0])
    written = write_as_given(tmp_path / "b.k", moved, Original(tmp_path / "a.k", mesh))
    assert "sub/nodes.k is written as sub/nodes-b.k." in written.notes
    np.testing.assert_array_equal(io.read(tmp_path / "b.k").points, moved.points)


@pytest.mark.parametrize(("old", "new", "words"), [
    (HEX, HEX[:40] + "       x" + HEX[48:], "*ELEMENT_SOLID in line 16 holds 'x': expected a whole number"),
    ("0.000000", "0.00x000", "*NODE in line 6 holds '0.00x000': expected a number"),
    ("*ELEMENT_SOLID", "*ELEMENT_SOLID_H20", "*ELEMENT_SOLID_H20 in line 14 is a form of solids that is not read"),
    (HEX, HEX[:64] + "\n", "*ELEMENT_SOLID in line 14 has 6 nodes in line 16: expected 8"),
    (HEX, HEX[:16] + "\n", "has 1 line: expected 2 an element"),
    ("*NODE\n$", "*NODE_MERGE\n$", "has no *NODE"),
    (HEX, HEX.replace("11", "99"), "node 99 is used"),
    ("*TITLE", "*INCLUDE_TRANSFORM\nb.k\n*TITLE", "moves and renumbers what it includes"),
    ("*TITLE", "*INCLUDE\nb.k\n*TITLE", "*INCLUDE in line 2 of a.k reads 'b.k', which does not exist"),
])  # fmt: skip
def test_what_is_wrong_is_named(old, new, words, tmp_path):
    assert old in DECK
    with pytest.raises(FileError) as error:
        read(DECK.replace(old, new, 1), tmp_path)
    assert words in str(error.value)


def test_what_a_new_deck_holds_is_read_again(tmp_path):
    mesh = with_everything(8)
    back = read_back(tmp_path / "a.k", mesh)
    assert back.hexes.tolist() == mesh.hexes.tolist()
    assert {one.kind for one in back.cells} == {one.kind for one in mesh.cells if one.dimension == 3}
    assert {name: sorted(rows.tolist()) for name, rows in back.node_sets.items()} == {
        name: sorted(rows.tolist()) for name, rows in mesh.node_sets.items() if len(rows)
    }
    assert back.side_sets.keys() == {name for name, rows in mesh.side_sets.items() if len(rows)}
