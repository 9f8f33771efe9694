"""Bytes of a file that is not in memory: as of bytes, and what happens where another program shortens the file."""

import os
from pathlib import Path

import numpy as np
import pytest

from hexmend.errors import FileError
from hexmend.io.base.cursor import ByteCursor
from hexmend.io.storage.binary_rows import FileBytes, read_blocks, read_rows

DATA = np.random.default_rng(5).integers(0, 256, 300_000, dtype=np.uint8).tobytes()


@pytest.fixture
def path(tmp_path):
    path = tmp_path / "file"
    path.write_bytes(DATA)
    return path


@pytest.mark.parametrize(
    ("begin", "end"), [(5, 2), (65_000, 66_000), (10, 200_000), (299_990, 400_000), (400_000, 400_010)]
)
def test_slices_are_those_of_bytes(path, begin, end):
    data = FileBytes(path)
    assert data[begin:end] == DATA[begin:end]
    assert data[begin + 1 : end] == DATA[begin + 1 : end]  # from the window that is held now
    assert len(data) == len(DATA)
    assert data[:] == DATA


@pytest.mark.parametrize("at", [0, 7, 65_533, 65_536, 131_070, 299_997])
def test_marks_are_found_across_the_parts_that_are_searched(tmp_path, at):
    content = bytearray(300_000)
    content[at : at + 3] = b"abc"
    (tmp_path / "file").write_bytes(content)
    data = FileBytes(tmp_path / "file")
    assert data.find(b"abc") == data.find(b"abc", at) == at
    assert data.find(b"abc", at + 1) == -1
    assert data.count(b"b", 0, 300_000) == 1
    assert data.count(b"b", 0, at + 1) == 0


def test_the_file_is_closed_with_its_last_reference(path):
    folder = Path("/proc/self/fd")
    if not folder.is_dir():
        pytest.skip("this system does not list the open files of a process")
    data = FileBytes(path)
    assert path in {Path(os.path.realpath(entry)) for entry in folder.iterdir()}
    del data
    assert path not in {Path(os.path.realpath(entry)) for entry in folder.iterdir()}


@pytest.mark.parametrize("shortened", [0, 100_000])
def test_a_file_that_is_shortened_meanwhile_is_an_error_and_not_the_end_of_the_program(path, shortened):
    data = FileBytes(path)
    os.truncate(path, shortened)
    with pytest.raises(OSError, match="shortened"):
        read_rows(data, 0, 200_000, 1, np.dtype("u1"))
    assert data[150_000:250_000] == b""


@pytest.mark.parametrize("held", [True, False])
def test_blocks_make_the_rows(path, held):
    data = DATA if held else FileBytes(path)
    whole = read_rows(data, 4, 30_000, 2, np.dtype(">i4"))
    found = np.empty_like(whole)
    for part, values in read_blocks(data, 4, 30_000, 2, np.dtype(">i4")):
        found[part] = values
    np.testing.assert_array_equal(found, whole)
    np.testing.assert_array_equal(whole.ravel(), np.frombuffer(DATA, ">i4", 60_000, 4))


ENDS_OF_NUMBERS = [
    ("1 2 3 4\nEND", 4, "END"),
    ("1 2 3 4 5 END", 4, "5 END"),
    ("1 2 3 4 2nd", 4, "2nd"),
    ("1 2 3 4", 4, ""),
    ("  1\n\n2\t3 4   \n", 4, ""),
]


@pytest.mark.parametrize("held", [True, False])
@pytest.mark.parametrize(("text", "count", "rest"), ENDS_OF_NUMBERS)
def test_numbers_end_where_they_did(tmp_path, monkeypatch, held, text, count, rest):
    monkeypatch.setattr("hexmend.io.base.cursor._TEXT", 4)  # words lie across the blocks
    (tmp_path / "file").write_text(text)
    cursor = ByteCursor(tmp_path / "file", text.encode() if held else FileBytes(tmp_path / "file"))
    assert cursor.read_numbers("numbers", count, 1, np.int64).ravel().tolist() == [1, 2, 3, 4]
    assert cursor.data[cursor.pos :].decode().strip() == rest


ERRORS = [
    ("1 2\n3 x4\n5 6", "row 2 of 3 .line 2.: expected a whole number"),
    ("1 2\n3 4\nEND", "ends after 2 of 3 rows: line 3 continues with 'END'"),
    ("1 2\n3 4\n", "ends after 2 of 3 rows: the file ends at line 3"),
    ("1 2\n3 4\n5 99999999999999999999\n", "a whole number of more than 64 bits before line 4"),
]


@pytest.mark.parametrize("held", [True, False])
@pytest.mark.parametrize(("text", "message"), ERRORS)
def test_errors_in_numbers_are_those_of_a_text_that_is_held(tmp_path, held, text, message):
    (tmp_path / "file").write_text(text)
    cursor = ByteCursor(tmp_path / "file", text.encode() if held else FileBytes(tmp_path / "file"))
    with pytest.raises(FileError, match=message):
        cursor.read_numbers("numbers", 3, 2, np.int64)
