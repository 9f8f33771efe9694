"""Files are replaced safely: on the disk before they are renamed, without names shared, without leftovers."""

import errno
import os

import pytest

from hexmend import FileError, gallery, io
from hexmend.io.storage.atomic import atomic_files, atomic_write


def files(folder):
    return sorted(path.name for path in folder.iterdir())


@pytest.fixture
def recorded(monkeypatch):
    """Calls of `os.fsync` and `os.replace`, in order: the name of the file or the folder that each was about."""
    calls, flush, replace = [], os.fsync, os.replace

    def recorded_flush(handle):
        calls.append(("fsync", os.path.basename(os.readlink(f"/proc/self/fd/{handle}"))))
        flush(handle)

    def recorded_replace(source, target):
        calls.append(("replace", os.path.basename(source), os.path.basename(target)))
        replace(source, target)

    monkeypatch.setattr(os, "fsync", recorded_flush)
    monkeypatch.setattr(os, "replace", recorded_replace)
    return calls


needs_proc = pytest.mark.skipif(not os.path.isdir("/proc/self/fd"), reason="no /proc")


@needs_proc
def test_a_file_is_on_the_disk_before_it_is_renamed_and_its_name_after(tmp_path, recorded):
    io.write(tmp_path / "mesh.vtu", gallery.make("cube", size=8))
    (_, temporary), *rest = recorded
    assert temporary.startswith(".hexmend-")
    assert temporary.endswith(".vtu")
    assert rest == [("replace", temporary, "mesh.vtu"), ("fsync", tmp_path.name)]


@needs_proc
def test_a_disk_that_is_full_when_the_file_is_flushed_leaves_the_old_file(tmp_path, monkeypatch):
    path = tmp_path / "mesh.vtk"
    path.write_text("old")

    def full(handle):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(FileError, match="No space left"), atomic_write(path) as temporary:
        temporary.write_text("new")
    assert path.read_text() == "old"
    assert files(tmp_path) == ["mesh.vtk"]


def test_a_file_system_that_cannot_flush_is_written_to(tmp_path, monkeypatch):
    def cannot(handle):
        raise OSError(errno.EINVAL, os.strerror(errno.EINVAL))

    monkeypatch.setattr(os, "fsync", cannot)
    with atomic_write(tmp_path / "mesh.vtk") as temporary:
        temporary.write_text("new")
    assert (tmp_path / "mesh.vtk").read_text() == "new"


@pytest.mark.parametrize("error", [ValueError, KeyboardInterrupt])
def test_nothing_is_left_beside_a_file_that_is_not_written_to_its_end(tmp_path, error):
    with pytest.raises(error), atomic_write(tmp_path / "mesh.vtk") as temporary:
        temporary.write_text("half")
        raise error
    assert files(tmp_path) == []


def test_two_writers_of_a_file_have_a_temporary_file_each(tmp_path):
    path = tmp_path / "mesh.vtk"
    with atomic_write(path) as first, atomic_write(path) as second:
        assert first != second
        first.write_text("first")
        second.write_text("second")
        assert first.read_text() == "first"
    assert path.read_text() == "first"
    assert files(tmp_path) == ["mesh.vtk"]


@pytest.mark.parametrize("name", ["m" * 251 + ".vtk", "é" * 125 + ".vtk", "m." + "s" * 253])
def test_a_name_as_long_as_names_may_be_can_be_written(tmp_path, name):
    with atomic_write(tmp_path / name) as temporary:
        temporary.write_text("new")
        assert files(tmp_path) == [temporary.name]
        assert temporary.suffix == (".vtk" if name.endswith(".vtk") else "")
    assert (tmp_path / name).read_text() == "new"


# Several files are replaced together, and errors name the file that they are about.


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
