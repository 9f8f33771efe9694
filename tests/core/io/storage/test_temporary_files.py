"""Files are replaced safely: on the disk before they are renamed, without names shared, without leftovers."""

import errno
import os

import pytest

from hexmend import FileError, gallery, io
from hexmend.io.storage.atomic import atomic_write


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
