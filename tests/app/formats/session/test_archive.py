"""Trees of plain data and arrays in one file: as they were, and nothing but data is ever taken from a file."""

import io
import json
import os
import shutil
import signal
import subprocess
import sys
import tracemalloc
import zipfile

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend.errors import FileError
from hexmend_app.formats.session.archive import DESCRIPTION, read_archive, write_archive
from hexmend_app.formats.session.folder import ArchiveFolder

KIND = "test tree"

leaves = st.none() | st.booleans() | st.integers(-(2**70), 2**70) | st.floats(allow_nan=False) | st.text(max_size=5)
names = st.text(max_size=4) | st.sampled_from(["$array", "$", "$$array"])
trees = st.recursive(leaves, lambda inner: st.lists(inner, max_size=3) | st.dictionaries(names, inner, max_size=3))


@given(tree=trees)
def test_plain_data_is_read_as_it_was_written(tree, tmp_path_factory):
    path = tmp_path_factory.mktemp("tree") / "a.zip"
    write_archive(path, KIND, 1, tree)
    assert read_archive(path, KIND, 1) == tree


@pytest.mark.parametrize("array", [
    np.arange(6, dtype=np.int64).reshape(2, 3),
    np.asfortranarray(np.random.default_rng(0).normal(size=(3, 4))),
    np.array([1.5, np.nan, -np.inf], dtype=">f4"),
    np.zeros((0, 3), np.int32),
    np.array(True),
    np.array(["a", "ödland"]),
    np.array(["a", "objects of text"], dtype=object),
    np.arange(20)[::3],
    np.zeros((1,) * 32, complex),
])  # fmt: skip
def test_arrays_are_read_bit_for_bit(array, tmp_path):
    write_archive(tmp_path / "a.zip", KIND, 1, [array])
    (back,) = read_archive(tmp_path / "a.zip", KIND, 1)
    np.testing.assert_array_equal(back, array.astype(str) if array.dtype == object else array)
    assert back.dtype == array.dtype or array.dtype == object
    assert not back.flags.writeable


def test_an_array_in_two_places_is_one_array_again(tmp_path):
    shared, other = np.zeros(1000), np.zeros(1000)
    write_archive(tmp_path / "a.zip", KIND, 1, {"a": shared, "b": [shared, other]})
    back = read_archive(tmp_path / "a.zip", KIND, 1)
    assert back["a"] is back["b"][0]
    assert back["b"][1] is not back["a"]
    assert (tmp_path / "a.zip").stat().st_size < 18_000


@pytest.mark.parametrize("value", [{1: 2}, {1, 2}, object(), np.array([None]), np.array([1, "a"], dtype=object)])
def test_what_is_no_data_is_not_written(value, tmp_path):
    with pytest.raises(FileError, match="cannot hold"):
        write_archive(tmp_path / "a.zip", KIND, 1, value)


# What is refused


def made(path, description=None, members=(), compression=zipfile.ZIP_STORED):
    """An archive of any content."""
    whole = {"format": KIND, "version": 1, "data": [1, {"$array": 0}]} if description is None else description
    with zipfile.ZipFile(path, "w", compression) as archive:
        archive.writestr(DESCRIPTION, whole if isinstance(whole, str) else json.dumps(whole))
        for name, content in members:
            archive.writestr(name, content)
    return path


def npy(array):
    """An array as .npy."""
    file = io.BytesIO()
    np.lib.format.write_array(file, array, allow_pickle=True)
    return file.getvalue()


THREE = np.arange(3).tobytes()


def lying(shape, kind="<i8", content=THREE):
    """Three numbers, or any content, as .npy with a head of any shape and type."""
    head = f"{{'descr': '{kind}', 'fortran_order': False, 'shape': {shape}, }}".ljust(117) + "\n"
    return b"\x93NUMPY\x01\x00" + len(head).to_bytes(2, "little") + head.encode() + content


ARRAY = ("arrays/0.npy", npy(np.arange(3)))


@pytest.mark.parametrize(("description", "said"), [
    ({"format": "another", "version": 1, "data": 1}, "is not a test tree"),
    ([1], "is not a test tree"),
    ({"format": KIND, "version": 2, "data": 1}, "is of version 2: expected 1. Use the Hexmend that wrote it."),
    ({"format": KIND, "version": "1", "data": 1}, "is of version '1': expected 1"),
    ({"format": KIND, "version": True, "data": 1}, "is of version True: expected 1"),
    ({"format": KIND, "version": 1}, "has no data"),
    ({"format": KIND, "version": 1, "data": 1, "code": "x"}, "unknown field 'code'"),
    ({"format": KIND, "version": 1, "data": {"$array": 5}}, "arrays/5.npy, which it does not contain"),
    ({"format": KIND, "version": 1, "data": {"$array": "../0"}}, "which it does not contain"),
    ("{", "is damaged"),
    ("[" * 200_000, "nested too deeply"),
    ("9" * 10_000, "is damaged"),
])  # fmt: skip
def test_a_description_that_is_not_ours_is_refused(description, said, tmp_path):
    with pytest.raises(FileError, match=said):
        read_archive(made(tmp_path / "a.zip", description, [ARRAY]), KIND, 1)


@pytest.mark.parametrize(("member", "said"), [
    (("arrays/0.npy", npy(np.array([{}]))), "is not an array of numbers"),
    (("arrays/0.npy", lying("(9**9,)")), "is not an array"),
    (("arrays/0.npy", lying("(300000000000,)")), "has the shape"),
    (("arrays/0.npy", lying("(-3, -1)")), "is not an array"),
    (("arrays/0.npy", lying("(3,), } ")), "is not an array"),
    (("arrays/0.npy", lying(f"({'1' * 500}x")), "is not an array"),
    (("arrays/0.npy", lying(f"({'1' * 60_000}x")), "is not an array"),
    (("arrays/0.npy", lying("(3,)" + " " * 2000)), "is not an array"),
    (("arrays/0.npy", lying("(" + "1, " * 33 + ")")), "is not an array"),
    (("arrays/0.npy", lying("(3,)", "<i7")), "is damaged"),
    (("arrays/0.npy", lying("(1000000000,)", "<U0", b"")), "has the shape"),
    (("arrays/0.npy", lying("(100000000000000,)", "|S00", b"")), "has the shape"),
    (("arrays/0.npy", lying("(3,)", "<i4")), "has the shape"),
    (("arrays/0.npy", lying("(3,)", "<M8[s]")), "is not an array of numbers or text"),
    (("arrays/0.npy", b"no array"), "is not an array"),
    (("../0.npy", b""), "does not know"),
    (("run.py", b"print()"), "does not know"),
    (("arrays/01.npy", b""), "does not know"),
])  # fmt: skip
def test_a_member_that_is_not_ours_is_refused(member, said, tmp_path):
    path = made(tmp_path / "a.zip", members=[member])
    tracemalloc.start()
    with pytest.raises(FileError, match=said):
        read_archive(path, KIND, 1)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 1 << 20


def test_an_array_that_does_not_fit_into_memory_is_refused(tmp_path, monkeypatch):
    def full(*_):
        raise MemoryError

    monkeypatch.setattr(np, "empty", full)
    with pytest.raises(FileError, match="does not fit into memory"):
        read_archive(made(tmp_path / "a.zip", members=[ARRAY]), KIND, 1)


def test_a_bomb_is_refused_before_it_is_unpacked(tmp_path):
    members = [("arrays/0.npy", npy(np.zeros(1_000_000)))]
    path = made(tmp_path / "a.zip", members=members, compression=zipfile.ZIP_DEFLATED)
    with pytest.raises(FileError, match="is compressed"):
        read_archive(path, KIND, 1)


def test_members_that_lie_over_one_another_are_refused(tmp_path):
    path = made(tmp_path / "a.zip", members=[ARRAY, ("arrays/1.npy", ARRAY[1])])
    content = path.read_bytes()
    size = (10**6).to_bytes(4, "little")
    at = content.rindex(b"PK\x01\x02")  # the directory's entry of the last member
    path.write_bytes(content[: at + 20] + size + size + content[at + 28 :])
    with pytest.raises(FileError, match="more than it has"):
        read_archive(path, KIND, 1)


@pytest.mark.filterwarnings("ignore:Duplicate name")
def test_a_member_that_is_there_twice_is_refused(tmp_path):
    with pytest.raises(FileError, match="twice"):
        read_archive(made(tmp_path / "a.zip", members=[ARRAY, ARRAY]), KIND, 1)


def test_a_file_that_is_cut_short_or_changed_is_called_damaged(tmp_path):
    write_archive(tmp_path / "a.zip", KIND, 1, [np.arange(1000)])
    whole = (tmp_path / "a.zip").read_bytes()
    for content in (whole[:-1], whole[:2000], whole[:3], whole.replace(bytes([7, 0, 0]), bytes([8, 0, 0]))):
        (tmp_path / "b.zip").write_bytes(content)
        with pytest.raises(FileError, match="is damaged"):
            read_archive(tmp_path / "b.zip", KIND, 1)


# A tree that is written again and again: only what is new of it, and whole at any moment.


#: Writes trees without end: each has a number, and arrays of which each is full of the number of an earlier tree or its.
_WRITER = """
import sys
from pathlib import Path
import numpy as np
from hexmend_app.formats.session.folder import ArchiveFolder

folder, arrays = ArchiveFolder(Path(sys.argv[1])), {}
for number in range(10**6):
    if len(arrays) > 6:
        del arrays[min(arrays, key=lambda name: int(name) * 7 % 5)]
    arrays[str(number)] = np.full(50_000, number)
    folder.write("test tree", 1, {"number": number, "arrays": arrays})
    print(number, flush=True)
"""


def arrays_in(path):
    """The files of arrays, and when each was written."""
    return {one.name: one.stat().st_mtime_ns for one in (path / "arrays").iterdir()}


def test_what_is_there_is_not_written_again_and_what_is_named_no_more_goes(tmp_path):
    folder, path = ArchiveFolder(tmp_path / "tree"), tmp_path / "tree"
    first, second, third = (np.arange(k) for k in (5, 6, 7))
    folder.write(KIND, 1, {"a": first, "b": [second, second]})
    before = arrays_in(path)
    folder.write(KIND, 1, [second, third])
    after = arrays_in(path)
    assert len(before) == len(after) == 2
    (kept,) = before.keys() & after.keys()
    assert before[kept] == after[kept]
    back = read_archive(path, KIND, 1)
    np.testing.assert_array_equal(back[0], second)
    np.testing.assert_array_equal(back[1], third)


def test_an_array_in_the_place_of_one_that_is_gone_is_written(tmp_path):
    folder = ArchiveFolder(tmp_path / "tree")
    for number in range(50):
        folder.write(KIND, 1, [np.full(3, number)])  # that soon lies where the one before lay
        assert read_archive(tmp_path / "tree", KIND, 1)[0].tolist() == [number] * 3


@pytest.mark.parametrize("gone", ["arrays/0.npy", "arrays", "."])
def test_what_was_removed_meanwhile_is_written_again(tmp_path, gone):
    path, folder, arrays = tmp_path / "tree", ArchiveFolder(tmp_path / "tree"), [np.arange(3), np.arange(4)]
    folder.write(KIND, 1, arrays)
    if (path / gone).is_dir():
        shutil.rmtree(path / gone)
    else:
        (path / gone).unlink()
    for more in (1, 2):
        folder.write(KIND, 1, [*arrays, more])
        *back, last = read_archive(path, KIND, 1)
        assert [one.tolist() for one in back] == [one.tolist() for one in arrays]
        assert last == more
    assert len(arrays_in(path)) == 2


def test_another_writer_goes_on_in_the_same_folder(tmp_path):
    path, array = tmp_path / "tree", np.arange(3)
    ArchiveFolder(path).write(KIND, 1, [array, 1])
    ArchiveFolder(path).write(KIND, 1, [array, 2])
    assert len(arrays_in(path)) == 1
    assert read_archive(path, KIND, 1)[1] == 2


@pytest.mark.parametrize("data", [[object()], [np.zeros(3), np.array([None])]])
def test_where_a_tree_cannot_be_written_the_last_one_stays(tmp_path, data):
    path, folder = tmp_path / "tree", ArchiveFolder(tmp_path / "tree")
    folder.write(KIND, 1, [np.arange(3)])
    with pytest.raises(FileError, match="cannot hold"):
        folder.write(KIND, 1, data)
    assert read_archive(path, KIND, 1)[0].tolist() == [0, 1, 2]


def test_where_the_description_cannot_be_written_no_array_is_left(tmp_path):
    path, folder, array = tmp_path / "tree", ArchiveFolder(tmp_path / "tree"), np.arange(3)
    (path / DESCRIPTION).mkdir(parents=True)
    with pytest.raises(FileError):
        folder.write(KIND, 1, [array])
    assert arrays_in(path) == {}
    (path / DESCRIPTION).rmdir()
    folder.write(KIND, 1, [array])
    assert read_archive(path, KIND, 1)[0].tolist() == [0, 1, 2]


@pytest.mark.slow
def test_whenever_its_writer_is_killed_the_tree_is_whole(tmp_path):
    path = tmp_path / "tree"
    for writes in (1, 2, 5, 9, 14):
        environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
        command = [sys.executable, "-c", _WRITER, str(path)]
        with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment) as process:
            told = [process.stdout.readline() for _ in range(writes)]
            process.send_signal(signal.SIGKILL)  # wherever it is in the next ones
        tree = read_archive(path, KIND, 1)
        assert tree["number"] >= int(told[-1])
        assert str(tree["number"]) in tree["arrays"]
        for name, array in tree["arrays"].items():
            assert (array == int(name)).all()
            assert array.size == 50_000


@pytest.mark.parametrize(("spoil", "said"), [
    (lambda path: (path / DESCRIPTION).unlink(), "has no description.json"),
    (lambda path: (path / "arrays/0.npy").unlink(), "arrays/0.npy, which it does not contain"),
    (lambda path: (path / "arrays/0.npy").write_bytes(b"\x93NUMPY"), "is not an array"),
    (lambda path: (path / DESCRIPTION).write_text("{"), "is damaged"),
])  # fmt: skip
def test_a_folder_that_is_damaged_is_refused(tmp_path, spoil, said):
    path = tmp_path / "tree"
    ArchiveFolder(path).write(KIND, 1, [np.arange(3)])
    spoil(path)
    with pytest.raises(FileError, match=said):
        read_archive(path, KIND, 1)


def test_no_link_is_followed(tmp_path):
    path = tmp_path / "tree"
    ArchiveFolder(path).write(KIND, 1, [np.arange(3)])
    (path / "arrays/0.npy").rename(tmp_path / "elsewhere.npy")
    (path / "arrays/0.npy").symlink_to(tmp_path / "elsewhere.npy")
    with pytest.raises(FileError, match="which it does not contain"):
        read_archive(path, KIND, 1)


@pytest.mark.skipif(not os.path.isdir("/proc/self/fd"), reason="no /proc")
def test_only_new_arrays_are_flushed_before_the_description_names_them(tmp_path, monkeypatch):
    flushed, flush = [], os.fsync

    def recorded_flush(handle):
        flushed.append(os.path.basename(os.readlink(f"/proc/self/fd/{handle}")))
        flush(handle)

    folder, first = ArchiveFolder(tmp_path / "session"), np.arange(3)
    folder.write("test", 1, [first])
    monkeypatch.setattr(os, "fsync", recorded_flush)
    folder.write("test", 1, [first, np.arange(4), np.arange(5)])
    *arrays, description, parent = flushed
    assert arrays == ["1.npy", "2.npy", "arrays"]
    assert description.endswith(".json")
    assert parent == "session"
