"""A tree that is written again and again: only what is new of it, and whole at any moment."""

import os
import shutil
import signal
import subprocess
import sys

import numpy as np
import pytest

from hexmend.errors import FileError
from hexmend_app.formats.session.archive import DESCRIPTION, read_archive
from hexmend_app.formats.session.folder import ArchiveFolder

KIND = "test tree"

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
