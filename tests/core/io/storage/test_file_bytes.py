"""Bytes of a file that is not in memory: as of bytes, and what happens where another program shortens the file.

Reading in another process: what comes back, and what is said where nothing does.

TOML files: read with what is wrong said by file, written as a whole.
"""

import os
from pathlib import Path

import numpy as np
import pytest

from hexmend.errors import FileError, ParameterError
from hexmend.io.base.cursor import ByteCursor
from hexmend.io.storage import binary_rows as maps
from hexmend.io.storage.binary_rows import FileBytes, parallel_map, read_blocks, read_rows
from hexmend.io.storage.subprocess_reader import run_reader
from hexmend.io.storage.suffixes import suffix_for
from hexmend.io.storage.toml_files import read_toml, write_toml

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


READERS = """
import os, signal
from hexmend.errors import FileError
def dies(path): os.kill(os.getpid(), signal.SIGSEGV)
def fails(path): raise ZeroDivisionError
def refuses(path): raise FileError(path, "has a hole in it", "Mend it.")
def swallows(path): bytearray(1 << 50)
"""


READER_ENDINGS = [
    ("dies", "ends the library that reads it"),
    ("fails", r"its reader fails \(ZeroDivisionError\)"),
    ("swallows", "needs more memory than"),
    ("refuses", r"^some\.dat: has a hole in it\. Mend it\.$"),
]


@pytest.mark.parametrize(("reader", "words"), READER_ENDINGS)
def test_whatever_the_reader_does_this_process_says_it(reader, words, tmp_path, monkeypatch):
    (tmp_path / "readers_that_fail.py").write_text(READERS)
    monkeypatch.syspath_prepend(tmp_path)
    (tmp_path / "some.dat").write_bytes(b"x")
    with pytest.raises(FileError, match=words):
        run_reader(f"readers_that_fail:{reader}", tmp_path / "some.dat")


def refuses(text):
    raise ParameterError(f"line 1 holds {text!r}")


def test_what_is_written_is_read(tmp_path):
    path = tmp_path / "one.toml"
    write_toml(path, "a recipe", "title = 'Größe'\n")
    assert read_toml(path, "a recipe", str.strip) == "title = 'Größe'"


def test_what_is_wrong_names_the_file_and_what_to_do(tmp_path):
    path = tmp_path / "one.toml"
    path.write_text("x")
    with pytest.raises(FileError, match=r"one\.toml: line 1 holds 'x'.*Correct the file"):
        read_toml(path, "a recipe", refuses)


def test_a_text_that_is_too_long_is_not_handed_on(tmp_path):
    path = tmp_path / "one.toml"
    path.write_text("x" * 11)
    with pytest.raises(FileError, match="expected a scene, of 10 at most"):
        read_toml(path, "a scene", refuses, largest=10)


def test_another_suffix_is_refused_before_anything_is_written(tmp_path):
    path = tmp_path / "one.json"
    with pytest.raises(FileError, match=r"a scene cannot be written as \.json"):
        write_toml(path, "a scene", "")
    assert not path.exists()


# What is written under a suffix that it cannot have is refused with those that it can.


@pytest.mark.parametrize("name", ["a.csv", "a.CSV", "b.md", "c.d.md"])
def test_a_suffix_that_there_is_is_told_in_small_letters(name):
    assert suffix_for(name, "a table", [".csv", ".md"]) == f".{name.rpartition('.')[2].lower()}"


def test_no_suffix_is_admitted_only_where_it_is_named():
    assert suffix_for("/dev/stdout", "a table", [".csv", ""]) == ""
    with pytest.raises(FileError, match=r"as a file without a suffix. Use \.csv\.$"):
        suffix_for("table", "a table", [".csv"])


# A function over many items in several threads: in their order, and the first error is raised.


@pytest.fixture(params=[1, 3])
def threads(request, monkeypatch):
    monkeypatch.setattr(maps, "threads", lambda: request.param)


def square(item):
    if item < 0:
        raise ValueError(f"{item} is negative")
    return item**2


@pytest.mark.usefixtures("threads")
def test_results_are_in_the_order_of_the_items_and_so_are_errors():
    assert list(parallel_map(square, range(10))) == [k**2 for k in range(10)]
    assert list(parallel_map(square, [])) == []
    with pytest.raises(ValueError, match="-1 is negative"):
        list(parallel_map(square, [1, 2, 3, -1, -2]))
