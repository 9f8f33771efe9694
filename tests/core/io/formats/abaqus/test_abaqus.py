"""Abaqus input files: written by Gmsh 4.15, written by hand, and written and read again."""

import errno
import os

import numpy as np
import pytest

from hexmend import FileError, io
from hexmend.doctor import examine, repair
from hexmend.io import Original, write_as_given
from hexmend.mesh.hexahedron import FACES, UNIT_CUBE
from hexmend.mesh.second_order import MID_NODE_POSITIONS
from tests.core.grids import displaced, grid
from tests.core.io.kept import middles_are_in_the_middle, read_back, read_content

#: Faces S1 to S6 as the manual numbers their corners.
SIDES = ["1 2 3 4", "5 8 7 6", "1 5 6 2", "2 6 7 3", "3 7 8 4", "4 8 5 1"]


def cube(ids=range(1, 9)) -> str:
    return "".join(f"{k}, {x:g}, {y:g}, {z:g}\n" for k, (x, y, z) in zip(ids, UNIT_CUBE, strict=True))


DECK = f"""\
*Heading
 A cube ** and no comment
** PARTS
*node, nset=All Nodes
{cube(range(11, 19))}
*Element, type = C3D8R , elset=Body
 5, 11, 12, 13, 14,
 15, 16, 17, 18
*Nset, nset="wall (west)", generate
 11, 15, 4
*NSET,
 NSET=both
 WALL, 12
*nset, nset=wall
 11,
 13
*Elset, elset=all
 body
*Surface, type=ELEMENT, name=Top
 BODY, S2
 5, S6
*Material, name=Steel
*Elastic
 210000., 0.3
*Step
*End Step
"""


def read(text, tmp_path):
    return read_content(tmp_path / "a.inp", text)


def test_a_deck_written_by_hand_is_read(tmp_path):
    mesh = read(DECK, tmp_path)
    assert mesh.hexes.tolist() == [list(range(8))]
    assert mesh.node_data["id"].tolist() == list(range(11, 19))
    assert mesh.hex_data["id"].tolist() == [5]
    assert {name: members.tolist() for name, members in mesh.node_sets.items()} == {
        "All Nodes": list(range(8)), "wall (west)": [0, 4], "both": [0, 1, 2], "wall": [0, 2],
    }  # fmt: skip
    assert {name: members.tolist() for name, members in mesh.hex_sets.items()} == {"Body": [0], "all": [0]}
    assert {name: rows.tolist() for name, rows in mesh.side_sets.items()} == {"Top": [[0, 5], [0, 0]]}
    assert mesh.field_data["abaqus:types"] == ["C3D8R"]
    assert "*MATERIAL" in mesh.notes[0]


@pytest.mark.parametrize("side", range(6))
def test_the_sides_of_a_hex_are_those_of_the_manual(side, tmp_path):
    deck = f"*NODE\n{cube()}*ELEMENT, TYPE=C3D8\n1, 1, 2, 3, 4, 5, 6, 7, 8\n*SURFACE, NAME=s\n1, S{side + 1}\n"
    ((_, face),) = read(deck, tmp_path).side_sets["s"]
    assert sorted(FACES[face] + 1) == sorted(map(int, SIDES[side].split()))


def test_the_27_nodes_of_a_hex_have_the_order_of_the_manual(tmp_path):
    places = [*UNIT_CUBE, *MID_NODE_POSITIONS[:12], [0.5, 0.5, 0.5]]
    places += [UNIT_CUBE[[int(k) - 1 for k in side.split()]].mean(axis=0) for side in SIDES]
    nodes = "".join(f"{k + 1}, {x}, {y}, {z}\n" for k, (x, y, z) in enumerate(places))
    row = ", ".join(map(str, range(1, 16))) + ",\n" + ", ".join(map(str, range(16, 28)))
    middles_are_in_the_middle(read(f"*NODE\n{nodes}*ELEMENT, TYPE=C3D27\n1, {row}\n", tmp_path))


def test_element_types_survive(tmp_path):
    deck = DECK + f"*NODE\n{cube(range(21, 29))}*ELEMENT, TYPE=C3D8I\n6, 21, 22, 23, 24, 25, 26, 27, 28\n"
    deck += "*ELEMENT, TYPE=M3D4\n7, 11, 12, 13, 14\n"
    io.write(tmp_path / "b.inp", read(deck, tmp_path))
    written = (tmp_path / "b.inp").read_text()
    assert [line.split("=")[1] for line in written.splitlines() if "*ELEMENT" in line] == ["C3D8R", "C3D8I", "M3D4"]


def test_a_generated_range_of_a_set_is_not_expanded(tmp_path):
    mesh = read(DECK + "*NSET, NSET=x, GENERATE\n1, 99999999999999, 2\n", tmp_path)
    assert mesh.node_sets["x"].tolist() == [0, 2, 4, 6]
    many = "".join(f"*NSET, NSET=s{k}, GENERATE\n1, 99999\n" for k in range(4))
    nodes = "".join(f"{k}, 0, 0, 0\n" for k in range(1, 9))
    mesh = read(f"*NODE\n{nodes}*ELEMENT, TYPE=C3D8\n1, 1, 2, 3, 4, 5, 6, 7, 8\n{many}", tmp_path)
    assert len(mesh.node_sets) == 4


def test_blank_fields_and_exponents_with_d_are_numbers(tmp_path):
    nodes = cube().replace("2, 1, 0, 0", "2, 1.0D+00, , ").replace("4, 0, 1, 0", "4,,1.d0")
    mesh = read(f"*NODE\n{nodes}*ELEMENT, TYPE=C3D8\n1, 1, 2, 3, 4, 5, 6, 7, 8\n", tmp_path)
    np.testing.assert_array_equal(mesh.points, UNIT_CUBE)


def test_elements_of_other_types_are_left_out_with_a_note(tmp_path):
    deck = (
        DECK
        + "*ELEMENT, TYPE=COH3D8, ELSET=glue\n70, 11, 12, 13, 14,\n15, 16, 17, 18\n71, 11, 12, 13, 14, 15, 16, 17, 18\n"
    )
    deck += (
        "*ELEMENT, TYPE=MASS, ELSET=glue\n72, 11\n*SURFACE, NAME=mixed\nglue, S1\n5, SPOS\n*NSET, NSET=some\n11, 99\n"
    )
    mesh = read(deck, tmp_path)
    assert mesh.n_hexes == 1
    assert mesh.cells[0].kind == "vertex"
    assert mesh.cells[0].sets["glue"].tolist() == [0]
    assert mesh.node_sets["some"].tolist() == [0]
    assert "mixed" not in mesh.side_sets
    assert any("2 elements of other types (COH3D8), whose nodes stay" in note for note in mesh.notes)
    assert any("1 member of a set does not exist" in note for note in mesh.notes)
    assert any("4 entries of surfaces" in note for note in mesh.notes)


ONE_HEX = f"*NODE\n{cube()}*ELEMENT, TYPE=C3D8, ELSET=E\n"


@pytest.mark.parametrize(
    ("lines", "is_longer"),
    [
        ("1, 1, 2, 3, 4, 5, 6, 7, 8, 1, 2,\n", True),
        ("1, 1, 2, 3, 4,\n5, 6, 7, 8, 9\n", True),
        ("1, 1, 2, 3, 4\n5, 6, 7, 8\n", False),
    ],
)
def test_an_element_is_read_from_its_own_lines(lines, is_longer, tmp_path):
    second = "2, 2, 1, 4, 3, 6, 5, 8, 7\n"
    (tmp_path / "a.inp").write_text(ONE_HEX + lines + second)
    mesh = io.read(tmp_path / "a.inp", as_is=True)
    assert mesh.hexes.tolist() == [list(range(8)), [1, 0, 3, 2, 5, 4, 7, 6]]
    assert any("by more numbers" in note for note in mesh.notes) == is_longer


def test_an_element_that_lacks_a_node_takes_none_of_the_next_one(tmp_path):
    with pytest.raises(FileError, match="the element in line 11 has 8 numbers: expected 9"):
        read(ONE_HEX + "1, 1, 2, 3, 4, 5, 6, 7\n2, 1, 2, 3, 4, 5, 6, 7, 8\n", tmp_path)


def test_node_sets_may_be_those_of_element_sets_and_share_names_with_node_surfaces(tmp_path):
    deck = ONE_HEX + "1, 1, 2, 3, 4, 5, 6, 7, 8\n*NODE\n9, 5, 5, 5\n*NSET, NSET=of E, ELSET=E\n*NSET, NSET=TOP\n5, 6\n"
    deck += "*SURFACE, TYPE=NODE, NAME=TOP\nTOP\n*SURFACE, TYPE=NODE, NAME=of E\n9,\n"
    sets = {name: nodes.tolist() for name, nodes in read(deck, tmp_path).node_sets.items()}
    assert sets == {"of E": list(range(8)), "TOP": [4, 5], "of E_2": [8]}


def test_sets_that_refer_to_missing_sets_are_read_with_a_note(tmp_path):
    mesh = read(ONE_HEX + "1, 1, 2, 3, 4, 5, 6, 7, 8\n*ELSET, ELSET=BOTH\nE, GONE\n", tmp_path)
    assert mesh.hex_sets["BOTH"].tolist() == [0]
    assert "Sets refer to 'GONE', which the file does not have: ignored." in mesh.notes


def test_the_last_of_two_lines_of_a_node_counts_and_is_replaced(tmp_path):
    path, deck = tmp_path / "a.inp", f"*NODE\n7, 9, 9, 9\n{cube()}*ELEMENT, TYPE=C3D8\n1, 1, 2, 3, 4, 5, 6, 7, 8\n"
    mesh = read_content(path, deck)
    np.testing.assert_array_equal(mesh.points, UNIT_CUBE)
    assert "1 node is given again by a later line, which counts." in mesh.notes
    assert write_as_given(tmp_path / "b.inp", displaced(mesh, [6], [0, 0, 0.25]), Original(path, mesh)).replaced
    assert (tmp_path / "b.inp").read_text() == deck.replace("7, 1, 1, 1", "7, 1, 1, 1.25")


def test_nodes_of_elements_that_are_not_read_and_of_cells_inside_stay(tmp_path):
    io.write(tmp_path / "a.inp", grid(4))
    text = (tmp_path / "a.inp").read_text()
    inner = io.read(tmp_path / "a.inp").node_data["id"][np.flatnonzero(grid(4).free)]
    spring, mass, *quad = inner[[0, 8, 13, 14, 17, 16]]
    text += f"*ELEMENT, TYPE=SPRINGA\n901, 1, {spring}\n*ELEMENT, TYPE=MASS\n902, {mass}\n"
    text += f"*ELEMENT, TYPE=S4R\n903, {', '.join(map(str, quad))}\n"
    mesh = read(text, tmp_path)
    kept = np.isin(mesh.node_data["id"], [spring, mass, *quad])
    np.testing.assert_array_equal(grid(4).free & ~mesh.free, kept)
    assert mesh.immovable[kept].all()
    assert any("1 element of other types (SPRINGA), whose nodes stay" in note for note in mesh.notes)


def test_reference_nodes_of_cards_that_are_not_read_are_used(tmp_path):
    deck = ONE_HEX + "1, 1, 2, 3, 4, 5, 6, 7, 8\n*NODE\n9, 5, 5, 5\n10, 6, 6, 6\n*RIGID BODY, ELSET=E, REF NODE=9\n"
    (finding,) = examine(read(deck, tmp_path))
    assert (finding.kind, finding.nodes.tolist()) == ("unused-nodes", [9])


def test_surfaces_stay_on_their_elements_when_blocks_are_reordered(tmp_path):
    """Blocks of hexes are written in the order of their node counts."""
    far = "".join(f"{k}, {x + 5:g}, {y:g}, {z:g}\n" for k, (x, y, z) in enumerate(UNIT_CUBE, 21))
    middles = "".join(f"{k}, {x:g}, {y:g}, {z:g}\n" for k, (x, y, z) in enumerate(MID_NODE_POSITIONS[:12], 9))
    deck = (
        f"*NODE\n{cube()}{middles}{far}*ELEMENT, TYPE=C3D20\n100, {', '.join(map(str, range(1, 16)))},\n"
        "16, 17, 18, 19, 20\n*ELEMENT, TYPE=C3D8\n200, 21, 22, 23, 24, 25, 26, 27, 28\n"
        "*SURFACE, NAME=S\n100, S1\n"
    )
    mesh = read(deck, tmp_path)
    back = read_back(tmp_path / "b.inp", mesh)
    for one in (mesh, back):
        ((hexa, face),) = one.side_sets["S"]
        assert one.hex_data["id"][hexa] == 100
        assert {tuple(p) for p in one.points[one.hexes[hexa][FACES[face]]]} == {tuple(p) for p in UNIT_CUBE[:4]}


@pytest.mark.parametrize(
    "card",
    [
        "*CONTACT PAIR, INTERACTION=I\nwest, east",
        "*Tie, name=T\nwest, east",
        "*CONTACT",
        "*EQUATION\n2\n2, 1, 1., 9, 1, -1.",
    ],
)
def test_touching_bodies_of_a_deck_with_contact_are_fit_and_stay_apart(card, tmp_path):
    path, shifted = tmp_path / "contact.inp", UNIT_CUBE + [1, 0, 0]
    nodes = "".join(f"{k + 9}, {x:g}, {y:g}, {z:g}\n" for k, (x, y, z) in enumerate(shifted))
    hexes = "1, 1, 2, 3, 4, 5, 6, 7, 8\n2, 9, 10, 11, 12, 13, 14, 15, 16\n"
    deck = f"*NODE\n{cube()}{nodes}*ELEMENT, TYPE=C3D8\n{hexes}"
    assert {finding.kind for finding in examine(read_content(path, deck))} == {"coincident-nodes", "parts"}
    mesh = read_content(path, f"{deck}{card}\n")
    assert {finding.kind for finding in examine(mesh)} == {"parts"}
    assert repair(mesh) == (mesh, ())


def test_a_note_says_that_nodes_with_conditions_move(tmp_path):
    io.write(tmp_path / "a.inp", grid(2))
    text = (tmp_path / "a.inp").read_text()
    note = "Nodes named in *BOUNDARY, *CLOAD move with the mesh: these keywords fix no node."
    assert note not in io.read(tmp_path / "a.inp").notes
    (tmp_path / "a.inp").write_text(text + "*STEP\n*CLOAD\n14, 1, 5.0\n*BOUNDARY\n1, 1, 3\n2, 1, 3\n*END STEP\n")
    assert note in io.read(tmp_path / "a.inp").notes


# Decks that include other files are read as one, and keep their files when coordinates are replaced.


NODES = "".join(f"{k}, {x:g}, {y:g}, {z:g}\n" for k, (x, y, z) in enumerate(UNIT_CUBE, 1))
HEX = "*ELEMENT, TYPE=C3D8, ELSET=BODY\n1, 1, 2, 3, 4, 5, 6, 7, 8\n"
MATERIAL = "** materials\n*MATERIAL, NAME=S\n*ELASTIC\n210000., 0.3"
DECKS = {
    "node data": ("*NODE, NSET=ALL, INPUT=sub/nodes.txt\n", NODES),
    "data after a keyword": ("*NODE\n*INCLUDE, INPUT=sub/nodes.txt\n", NODES),
    "whole keywords": ('** ours\n*Include,\n input = "sub/nodes.txt"\n', "*NODE\n" + NODES),
    "without a line end": ("*INCLUDE, INPUT=sub/nodes.txt\n", "*NODE\n" + NODES.rstrip("\n")),
}


@pytest.fixture(params=DECKS)
def deck(request, tmp_path):
    head, nodes = DECKS[request.param]
    folder = tmp_path / "given"
    (folder / "sub").mkdir(parents=True)
    (folder / "sub/nodes.txt").write_text(nodes)
    (folder / "material.inp").write_text(MATERIAL)
    (folder / "in.inp").write_text(head + HEX + "*INCLUDE, INPUT=material.inp\n*STEP\n*END STEP\n")
    return folder / "in.inp"


def moved(deck):
    mesh = io.read(deck)
    np.testing.assert_array_equal(mesh.points, UNIT_CUBE)
    return mesh, displaced(mesh, [2, 7], [0.125, 0.25, 0.5])


def lines(path):
    return path.read_text().split("\n")


@pytest.mark.parametrize("folder", ["given", "other"])
def test_files_with_moved_nodes_are_written_next_to_the_deck_under_a_new_name(deck, folder, tmp_path):
    given, mesh = moved(deck)
    before = contents(deck.parent)
    target = tmp_path / folder / "out.inp"
    target.parent.mkdir(exist_ok=True)
    written = write_as_given(target, mesh, Original(deck, given))
    assert written.replaced
    assert "sub/nodes.txt is written as sub/nodes-out.txt." in written.notes
    np.testing.assert_array_equal(io.read(target).points, mesh.points)
    assert before == {path: path.read_bytes() for path in before}
    assert target.read_text() == deck.read_text().replace("sub/nodes.txt", "sub/nodes-out.txt")
    assert (target.parent / "material.inp").read_text() == MATERIAL
    pairs = zip(lines(deck.parent / "sub/nodes.txt"), lines(target.parent / "sub/nodes-out.txt"), strict=True)
    assert sum(a != b for a, b in pairs) == 2
    assert write_as_given(target, mesh, Original(deck, given)).replaced  # once more, on its own files


def test_a_deck_that_replaces_itself_replaces_its_files(deck):
    given, mesh = moved(deck)
    text = deck.read_text()
    written = write_as_given(deck, mesh, Original(deck, given))
    assert written.replaced
    assert written.notes == ("Coordinates are replaced in nodes.txt too.",)
    assert deck.read_text() == text
    np.testing.assert_array_equal(io.read(deck).points, mesh.points)


def test_nodes_of_files_that_include_files_are_found(tmp_path):
    (tmp_path / "in.inp").write_text("*INCLUDE, INPUT=a.inp\n" + HEX)
    (tmp_path / "a.inp").write_text("** a\n*INCLUDE, INPUT=b.inp\n** end of a\n")
    (tmp_path / "b.inp").write_text("*NODE\n" + NODES)
    given, mesh = moved(tmp_path / "in.inp")
    assert write_as_given(tmp_path / "out.inp", mesh, Original(tmp_path / "in.inp", given)).replaced
    np.testing.assert_array_equal(io.read(tmp_path / "out.inp").points, mesh.points)
    assert lines(tmp_path / "out.inp")[0] == "*INCLUDE, INPUT=a-out.inp"
    assert lines(tmp_path / "a-out.inp") == ["** a", "*INCLUDE, INPUT=b-out.inp", "** end of a", ""]


@pytest.mark.parametrize("included", [True, False])
def test_a_copy_never_takes_the_name_of_another_file(included, tmp_path):
    (tmp_path / "nodes.inp").write_text("*NODE\n" + NODES)
    (tmp_path / "nodes-2.inp").write_text(HEX)
    more = "*INCLUDE, INPUT=nodes-2.inp\n" if included else HEX
    (tmp_path / "in.inp").write_text("*INCLUDE, INPUT=nodes.inp\n" + more)
    given, mesh = moved(tmp_path / "in.inp")
    for _ in range(2):  # the second time, the new deck's own copy is replaced
        assert write_as_given(tmp_path / "2.inp", mesh, Original(tmp_path / "in.inp", given)).replaced
        np.testing.assert_array_equal(io.read(tmp_path / "2.inp").points, mesh.points)
        assert (tmp_path / "nodes-2.inp").read_text() == HEX
        assert len(list(tmp_path.iterdir())) == 5


def test_files_that_a_file_of_another_folder_includes_come_with_its_copy(tmp_path):
    for name, text in (("lib/all.inp", "*INCLUDE, INPUT=hex.inp\n*NODE\n" + NODES), ("lib/hex.inp", HEX)):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(text)
    (tmp_path / "given").mkdir()
    deck, target = tmp_path / "given/in.inp", tmp_path / "given/out.inp"
    deck.write_text("*INCLUDE, INPUT=../lib/all.inp\n")
    given, mesh = moved(deck)
    assert "hex.inp is copied next to the new deck." in write_as_given(target, mesh, Original(deck, given)).notes
    np.testing.assert_array_equal(io.read(target).points, mesh.points)
    again = write_as_given(target, mesh, Original(deck, given))
    assert again.notes == ("../lib/all.inp is written as all-out.inp.",)  # hex.inp is there, and the same


def test_errors_name_the_file_and_the_line(tmp_path):
    (tmp_path / "in.inp").write_text("** one\n*INCLUDE, INPUT=a.inp\n")
    for text, words in (
        ("*NODE\n1, 0, 0, 0\n*NGEN\n1, 2, 3\n", r"line 3 of a\.inp"),
        ("*INCLUDE, INPUT=in.inp\n", "include each other without end"),
        ("*INCLUDE, INPUT=no.inp\n", r"line 1 of a\.inp reads 'no\.inp', which does not exist"),
    ):
        (tmp_path / "a.inp").write_text(text)
        with pytest.raises(FileError, match=words):
            io.read(tmp_path / "in.inp")


def test_data_lines_may_be_cut_between_files_and_paths_be_those_of_windows(tmp_path):
    (tmp_path / "sub").mkdir()
    (tmp_path / "sub/rest.inp").write_text("5, 6, 7, 8\n")
    mesh = read(f"*NODE\n{NODES}*ELEMENT, TYPE=C3D8\n1, 1, 2, 3, 4,\n*INCLUDE, INPUT=sub\\rest.inp\n", tmp_path)
    assert mesh.hexes.tolist() == [list(range(8))]


def contents(folder):
    return {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}


@pytest.mark.parametrize("target", ["given/material.inp", "elsewhere/material.inp"])
def test_a_file_that_the_deck_includes_is_not_overwritten(deck, target, tmp_path):
    given, mesh = moved(deck)
    (tmp_path / "elsewhere").mkdir()
    before = contents(tmp_path)
    words = "is included by in" if target.startswith("given") else "has the name of a file that in"
    with pytest.raises(FileError, match=rf"material\.inp: {words}\.inp"):
        write_as_given(tmp_path / target, mesh, Original(deck, given))
    assert before == contents(tmp_path)


@pytest.mark.parametrize("target", ["in.inp", "out.inp"])
@pytest.mark.parametrize("n_before", [0, 1])
def test_files_are_replaced_together_or_not_at_all(deck, target, n_before, monkeypatch):
    given, mesh = moved(deck)
    before, replace, done = contents(deck.parent), os.replace, []

    def failing(source, path):
        if len(done) == n_before:
            done.append("failure")
            raise OSError(errno.EBUSY, "Device or resource busy", str(path))
        done.append(path.name)
        replace(source, path)

    monkeypatch.setattr(os, "replace", failing)
    with pytest.raises(FileError, match="cannot be replaced: Device or resource busy"):
        write_as_given(deck.with_name(target), mesh, Original(deck, given))
    monkeypatch.undo()
    assert contents(deck.parent) == before
