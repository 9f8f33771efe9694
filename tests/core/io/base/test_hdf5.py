"""Formats on HDF5: what is none is refused at once, and what is one is read in a process of its own."""

import signal

import pytest

from hexmend import FileError, io
from hexmend.io.storage import subprocess_reader
from tests.core.grids import grid

h5py = pytest.importorskip("h5py")
SUFFIXES = (".med", ".vtkhdf", ".cgns", ".exo")


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_what_is_no_hdf5_file_is_refused_without_another_process(suffix, tmp_path, monkeypatch):
    monkeypatch.setattr(subprocess_reader.subprocess, "run", lambda *_, **__: pytest.fail("a process was started"))
    path = tmp_path / f"a{suffix}"
    path.write_bytes(b"\x89HDF\r\n" + bytes(range(256)) * 8)
    with pytest.raises(FileError, match="is not an HDF5 file"):
        io.read(path)


@pytest.mark.parametrize(("suffix", "block"), [(".med", 0), (".cgns", 1024)])
def test_a_library_that_ends_takes_only_its_own_process_along(suffix, block, tmp_path, monkeypatch):
    path = tmp_path / f"a{suffix}"
    with h5py.File(path, "w", userblock_size=block) as file:
        file["a"] = 1
    (tmp_path / "h5py.py").write_text("import os, signal\nos.kill(os.getpid(), signal.SIGSEGV)\n")
    monkeypatch.syspath_prepend(tmp_path)
    with pytest.raises(FileError, match="ends the library that reads it"):
        io.read(path)


@pytest.mark.parametrize("suffix", [".med", ".vtkhdf"])
def test_a_full_disk_is_said_of_the_file_in_a_few_words(suffix, tmp_path):
    """A limit of the size of files stands for the disk; the library keeps what it could not write until it closes."""
    resource = pytest.importorskip("resource")
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    handler = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (4096, before[1]))
    try:
        with pytest.raises(FileError) as problem:
            io.write(tmp_path / f"a{suffix}", grid(6))
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
        signal.signal(signal.SIGXFSZ, handler)
    assert str(problem.value).startswith(f"a{suffix}: cannot be written: File too large. Check free space")
    assert list(tmp_path.iterdir()) == []
