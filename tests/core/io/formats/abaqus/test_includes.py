"""Decks that include other files are read as one, and keep their files when coordinates are replaced."""

import errno
import os

import numpy as np
import pytest

from hexmend import FileError, io
from hexmend.io import Original, write_as_given
from hexmend.mesh.hexahedron import UNIT_CUBE
from tests.core.grids import displaced

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
        (
            "*INSTANCE, NAME=I\n*INCLUDE, INPUT=b.inp\n",
            r"\*INSTANCE in .*line 1.* its data lines are elsewhere, in b\.inp",
        ),
        ("*ELEMENT, TYPE=C3D8\n1, 2,\n*INCLUDE, INPUT=b.inp\n", r"a line of its data continues elsewhere, in b\.inp"),
    ):
        (tmp_path / "b.inp").write_text("5, 0, 0\n")
        (tmp_path / "a.inp").write_text(text)
        with pytest.raises(FileError, match=words):
            io.read(tmp_path / "in.inp")


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
