"""Coordinates replaced in a file as it was given: everything else in it is as it was, to the byte."""

import re
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import hexmend as hx
from hexmend import FileError, io
from hexmend.io import Original, write_as_given
from hexmend.io.coordinates.located import CoordinatesError
from hexmend.io.coordinates.replacement import ChangedFileError, difference
from hexmend.io.coordinates.text_coordinates import (
    Edits,
    TextCoordinates,
    edited,
    fields_of_words,
    number_texts,
    parse_fields,
)
from hexmend.mesh.orientation import mirror_hexes
from tests.core.grids import displaced, grid
from tests.core.io.kept import assert_same, read_back, with_everything

FILES = Path(__file__).parents[1] / "files"
#: Formats in which coordinates are replaced, by a file's name.
WRITTEN = ["a.inp", "a.bdf", "a.msh", "a.exo", "a.med", "a.su2", "a.mesh", "a.meshb"]
#: Characters of a real number that a file holds exactly; others round to 14 digits.
ROUNDING = {".inp": 1e-12, ".bdf": 1e-11} | dict.fromkeys((".rad", ".feb", ".cdb"), 1e-15)
_NUMBER = re.compile(rb"[-+0-9.eEdD]+")


def moved(mesh, every=2):
    """The mesh with some of its nodes elsewhere, and which."""
    which = np.arange(mesh.n_nodes) % every == 0
    return displaced(mesh, which, 0.01 * np.random.default_rng(5).normal(size=(int(which.sum()), 3)))


def check(source: Path, target: Path):
    """Replace coordinates and compare what is read again; returns the mesh that was written and the notes."""
    given = io.read(source)
    mesh = moved(given)
    written = write_as_given(target, mesh, Original(source, given))
    assert written.replaced, written.notes
    again = io.read(target)
    scale = np.abs(mesh.points).max()
    np.testing.assert_allclose(again.points, mesh.points, rtol=0, atol=ROUNDING.get(source.suffix, 0) * scale)
    assert difference(again, mesh) == ""
    return mesh, written


def without_numbers(data: bytes) -> list[bytes]:
    return [b" ".join(_NUMBER.sub(b"#", line).split()) for line in data.split(b"\n")]


@pytest.mark.parametrize("name", sorted(path.name for path in FILES.iterdir()))
def test_files_of_other_programs_keep_all_but_their_coordinates(name, tmp_path):
    source, target = FILES / name, tmp_path / f"out{Path(name).suffix}"
    check(source, target)
    given, data = source.read_bytes(), target.read_bytes()
    if b"\0" in given:  # binary: the same length, and the same bytes at the places of other things
        same = np.frombuffer(given, np.uint8) == np.frombuffer(data, np.uint8)
        assert np.count_nonzero(~same) <= 24 * io.read(source).n_nodes
    elif name.endswith(".bdf"):  # GRID may become GRID*, of two lines
        assert [line for line in given.split(b"\n") if line[:1] not in b"G*"] == [
            line for line in data.split(b"\n") if line[:1] not in b"G*"
        ]
    else:
        assert without_numbers(given) == without_numbers(data)


@pytest.mark.parametrize("name", ["jet.exo", "n10-id2_hex.msh", "sphere_r9.msh", "bunny_projected.inp"])
def test_real_files_keep_all_but_their_coordinates(name, real_mesh, tmp_path):
    source = real_mesh(name)
    target = tmp_path / name
    mesh, _ = check(source, target)
    given, data = source.read_bytes(), target.read_bytes()
    if name != "jet.exo":
        lines = list(zip(given.split(b"\n"), data.split(b"\n"), strict=True))
        unchanged = sum(a == b for a, b in lines)
        assert len(lines) - unchanged == np.count_nonzero((io.read(source).points != mesh.points).any(axis=1))


@pytest.mark.parametrize("name", WRITTEN)
@pytest.mark.parametrize("order", [8, 20, 27])
def test_files_of_hexmend_keep_all_but_their_coordinates(name, order, tmp_path):
    if order > 8 and name in ("a.su2", "a.mesh", "a.meshb", "a.bdf"):
        pytest.skip("the format has no second order")
    io.write(tmp_path / name, with_everything(order))
    check(tmp_path / name, tmp_path / f"b{Path(name).suffix}")


@pytest.mark.parametrize("name", WRITTEN)
def test_nodes_that_have_not_moved_leave_the_file_as_it_is(name, tmp_path):
    source, target = tmp_path / name, tmp_path / f"b{Path(name).suffix}"
    mesh = read_back(source, with_everything())
    assert write_as_given(target, mesh, Original(source, mesh)).replaced
    assert source.read_bytes() == target.read_bytes()


@pytest.mark.parametrize("name", ["a.inp", "a.exo"])
def test_a_file_may_be_replaced_by_itself(name, tmp_path):
    source = tmp_path / name
    io.write(source, with_everything())
    mesh, _ = check(source, source)
    np.testing.assert_allclose(io.read(source).points, mesh.points, rtol=1e-11, atol=1e-13)
    assert [path.name for path in tmp_path.iterdir()] == [name]


def test_a_file_that_has_changed_meanwhile_is_written_anew_elsewhere_and_never_overwritten(tmp_path):
    source = tmp_path / "a.inp"
    given = read_back(source, with_everything())
    io.write(source, moved(given, 3))
    data = source.read_bytes()
    written = write_as_given(tmp_path / "b.inp", moved(given), Original(source, given))
    assert not written.replaced
    assert "has changed" in written.notes[0]
    with pytest.raises(ChangedFileError, match="changed since"):
        write_as_given(source, moved(given), Original(source, given))
    assert source.read_bytes() == data


def test_a_file_that_is_gone_is_written_anew_and_it_is_said(tmp_path):
    source = tmp_path / "a.inp"
    given = read_back(source, with_everything())
    source.unlink()
    written = write_as_given(tmp_path / "b.inp", given, Original(source, given))
    assert not written.replaced
    assert "a.inp does not exist any more" in written.notes[0]
    assert "other than the mesh: comments" in written.notes[0]
    assert write_as_given(tmp_path / "b.vtu", given, Original(source, given)).notes == ()


OTHER_DIFFERENCES = [
    (lambda mesh: mesh.replace(pinned=np.arange(mesh.n_nodes) == 3), "fixed nodes"),
    (lambda mesh: mesh.replace(node_sets={}), "node sets"),
    (lambda mesh: mesh.replace(cells=mesh.cells[:1]), "cells"),
    (lambda mesh: hx.Mesh(mesh.points, mesh.hexes[1:]), "hexes"),
]


@pytest.mark.parametrize(("change", "words"), OTHER_DIFFERENCES)
def test_a_mesh_that_differs_in_more_than_coordinates_is_written_anew_and_it_is_said(change, words, tmp_path):
    source, target = tmp_path / "a.exo", tmp_path / "b.exo"
    given = read_back(source, with_everything())
    mesh = change(given)
    written = write_as_given(target, mesh, Original(source, given))
    assert not written.replaced
    assert words in written.notes[0]
    assert io.read(target).n_hexes == mesh.n_hexes
    with pytest.raises(FileError, match=words):
        io.write(target, mesh, like=source)


def test_pins_that_the_format_cannot_hold_do_not_cost_the_rest_of_the_file(tmp_path):
    given = read_back(tmp_path / "a.inp", with_everything())
    mesh = moved(given).replace(pinned=np.ones(given.n_nodes, bool))
    assert write_as_given(tmp_path / "b.inp", mesh, Original(tmp_path / "a.inp", given)).replaced


@pytest.mark.parametrize("name", ["a.bdf", "a.inp"])
def test_a_file_that_has_rounded_coordinates_can_be_replaced_again(name, tmp_path):
    given = read_back(tmp_path / name, with_everything())
    first = moved(given)
    assert write_as_given(tmp_path / name, first, Original(tmp_path / name, given)).replaced
    second = moved(first, 3)
    assert write_as_given(tmp_path / name, second, Original(tmp_path / name, first)).replaced
    np.testing.assert_allclose(io.read(tmp_path / name).points, second.points, rtol=1e-10, atol=1e-13)


def test_hexes_that_were_turned_on_reading_stay_as_the_file_has_them(tmp_path):
    mesh = with_everything()
    mirrored = hx.Mesh(mesh.points * [1, 1, -1], mesh.hexes)
    given = read_back(tmp_path / "a.msh", mirrored, encoding="ascii")
    assert not np.array_equal(given.hexes, mirrored.hexes)
    written = write_as_given(tmp_path / "b.msh", moved(given), Original(tmp_path / "a.msh", given))
    assert any("inside out" in note for note in written.notes)
    hx.write(tmp_path / "b.msh", moved(given), like=tmp_path / "a.msh")
    np.testing.assert_array_equal(io.read(tmp_path / "b.msh", as_is=True).hexes, mirrored.hexes)


def test_a_file_in_which_some_hexes_are_left_handed_is_rewritten_with_all_of_them_right_handed(tmp_path):
    mesh = grid(3)
    mixed = mirror_hexes(mesh, np.arange(27) % 2 == 0)
    given = read_back(tmp_path / "a.msh", mixed, encoding="ascii")
    written = write_as_given(tmp_path / "b.msh", moved(given), Original(tmp_path / "a.msh", given))
    assert not written.replaced
    assert "some hexes of a.msh are numbered inside out" in written.notes[0]
    np.testing.assert_array_equal(io.read(tmp_path / "b.msh", as_is=True).hexes, mesh.hexes)
    with pytest.raises(FileError, match=r"numbered inside out.*Write it without"):
        hx.write(tmp_path / "c.msh", moved(given), like=tmp_path / "a.msh")


def test_coordinates_of_32_bits_stay_so_and_it_is_said(tmp_path):
    h5py = pytest.importorskip("h5py")
    io.write(tmp_path / "a.med", with_everything())
    with h5py.File(tmp_path / "a.med", "r+") as file:
        group = next(iter(next(iter(file["ENS_MAA"].values())).values()))["NOE"]
        values = group["COO"][()].astype(np.float32)
        attributes = dict(group["COO"].attrs)
        del group["COO"]
        group.create_dataset("COO", data=values, chunks=(16,), compression="gzip").attrs.update(attributes)
    given = io.read(tmp_path / "a.med")
    mesh = moved(given)
    written = write_as_given(tmp_path / "b.med", mesh, Original(tmp_path / "a.med", given))
    assert written.replaced
    assert "32-bit" in written.notes[0]
    again = io.read(tmp_path / "b.med")
    np.testing.assert_allclose(again.points, mesh.points, atol=1e-6 * np.abs(mesh.points).max())
    assert_same(again.with_points(mesh.points), mesh)


def test_fields_that_hold_other_numbers_than_were_read_are_never_replaced():
    begin = np.array([[0, 4, 8]])
    fields = fields_of_words(begin, begin + 3)
    points = np.array([[1.0, 2.0, 3.0]])
    good = TextCoordinates(b"1.0 2.0 3D0", points, fields)
    assert len(good.edits(points + 1)) == 3
    with pytest.raises(CoordinatesError, match="layout"):
        TextCoordinates(b"1.0 2.5 3D0", points, fields).edits(points + 1)
    with pytest.raises(CoordinatesError, match="layout"):
        TextCoordinates(b"1.0 2.x 3D0", points, fields).edits(points + 1)


# Parts of a text are replaced, whatever their number, place and length.


@given(st.data())
def test_parts_are_replaced_as_by_a_loop(data):
    text = data.draw(st.binary(max_size=60))
    places = sorted(data.draw(st.lists(st.integers(0, len(text)), max_size=12)))
    begin, end = places[: len(places) // 2 * 2 : 2], places[1::2]
    words = [data.draw(st.sampled_from([b"", b"7", b"-1.25", b"3.0000000001"])) for _ in begin]
    expected, at = b"", 0
    for first, last, word in zip(begin, end, words, strict=True):
        expected, at = expected + text[at:first] + word, last
    edits = Edits(np.array(begin, np.int64), np.array(end, np.int64), words)
    assert b"".join(edited(text, edits)) == expected + text[at:]


@given(st.lists(st.floats(allow_nan=False, allow_infinity=False), max_size=20))
def test_numbers_are_read_back_as_they_were_unless_a_width_limits_them(values):
    array = np.array(values)
    assert [float(word) for word in number_texts(array)] == values
    words = number_texts(array, width=20)
    assert all(len(word) <= 20 for word in words)
    np.testing.assert_allclose([float(word) for word in words], array, rtol=1e-12)


@pytest.mark.parametrize("end", ["\n", ""])
def test_fields_are_parsed_as_numbers_and_blank_ones_as_zero(end):
    text = f"1, 2.5, -1D3,, 1e-3{end}".encode()
    begin, end = np.array([0, 3, 8, 13, 15]), np.array([1, 6, 12, 13, 19])
    np.testing.assert_array_equal(parse_fields(text, begin, end), [1, 2.5, -1000, 0, 0.001])


@pytest.mark.parametrize("text", [b"1 2,", b"one,", b"1-2,"])
def test_fields_that_are_no_numbers_are_none(text):
    assert parse_fields(text, np.array([0]), np.array([len(text) - 1])) is None
