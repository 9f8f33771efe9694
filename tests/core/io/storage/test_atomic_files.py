"""Several files are replaced together, and errors name the file that they are about."""

import errno
import os

import pytest

from hexmend.errors import FileError
from hexmend.io.storage.atomic import atomic_files


@pytest.fixture
def two(tmp_path):
    (tmp_path / "a.txt").write_text("old a")
    (tmp_path / "b.txt").write_text("old b")
    (tmp_path / "a.txt").chmod(0o640)
    return tmp_path / "a.txt", tmp_path / "b.txt"


def test_all_files_are_replaced_the_first_last(two, monkeypatch):
    done, replace = [], os.replace
    monkeypatch.setattr(os, "replace", lambda source, path: (done.append(path.name), replace(source, path)))
    with atomic_files() as files:
        for path in (*two, two[0].with_name("new.txt")):
            files.add(path).write_text(f"new {path.stem}")
        assert [path.read_text() for path in two] == ["old a", "old b"]
    assert [path.read_text() for path in two] == ["new a", "new b"]
    assert done == ["new.txt", "b.txt", "a.txt"]
    assert sorted(os.listdir(two[0].parent)) == ["a.txt", "b.txt", "new.txt"]
    if os.name != "nt":
        assert two[0].stat().st_mode & 0o777 == 0o640


@pytest.mark.parametrize("named", [True, False])
def test_an_error_of_writing_names_the_file_and_not_the_temporary_one(two, named):
    words = rf"^{'b' if named else 'a'}\.txt: cannot be written: No space left"
    with pytest.raises(FileError, match=words), atomic_files() as files:
        files.add(two[0])
        temporary = files.add(two[1])
        raise OSError(errno.ENOSPC, "No space left on device", *([str(temporary)] if named else []))
    assert [path.read_text() for path in two] == ["old a", "old b"]
    assert sorted(os.listdir(two[0].parent)) == ["a.txt", "b.txt"]


def test_an_error_of_another_file_is_raised_as_it_is(two):
    with pytest.raises(FileNotFoundError), atomic_files() as files:
        files.add(two[0])
        (two[0].parent / "missing").read_text()


def test_what_cannot_be_restored_is_named(two, monkeypatch):
    replace = os.replace

    def failing(source, path):
        if path.name == "a.txt" or "old" in source.read_text():
            raise OSError(errno.EBUSY, "busy", str(path))
        replace(source, path)

    monkeypatch.setattr(os, "replace", failing)
    words = r"a\.txt: cannot be replaced: busy, and b\.txt cannot be restored: its old content is in (\S+)\. "
    with pytest.raises(FileError, match=words) as raised, atomic_files() as files:
        for path in two:
            files.add(path).write_text("new")
    (backup,) = [path for path in two[0].parent.iterdir() if path not in two]
    assert str(backup) in str(raised.value)
    assert backup.read_text() == "old b"
    monkeypatch.undo()
    with atomic_files() as files:
        files.add(two[1]).write_text("newer")
    assert backup.read_text() == "old b"


def test_a_temporary_file_that_cannot_be_made_leaves_nothing(two, monkeypatch):
    make = os.open

    def failing(path, flags, *mode):
        if ".hexmend-" in str(path):
            raise OSError(errno.ENOSPC, "No space left on device", str(path))
        return make(path, flags, *mode)

    monkeypatch.setattr(os, "open", failing)
    with pytest.raises(FileError, match=r"^a\.txt: cannot be written: No space left"), atomic_files() as files:
        files.add(two[0])
    assert sorted(os.listdir(two[0].parent)) == ["a.txt", "b.txt"]


def test_a_file_that_is_added_twice_is_one(two, monkeypatch):
    new, replace = two[0].with_name("new.txt"), os.replace

    def failing(source, path):
        if path == two[0]:
            raise OSError(errno.EBUSY, "busy", str(path))
        replace(source, path)

    monkeypatch.setattr(os, "replace", failing)
    words = r"a\.txt: cannot be replaced: busy; new\.txt is as before"
    with pytest.raises(FileError, match=words), atomic_files() as files:
        for path in (two[0], new, new):
            files.add(path).write_text("new")
    assert sorted(os.listdir(two[0].parent)) == ["a.txt", "b.txt"]
