"""Writing leaves no file open."""

import os
import sys

import pytest

from hexmend.io.storage.atomic import atomic_write


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="counts the open files of the process in /proc")
@pytest.mark.parametrize("there", [False, True])
def test_as_many_files_are_open_after_writing_as_before(there, tmp_path):
    path = tmp_path / "a.txt"
    if there:
        path.write_text("old")
    before = len(os.listdir("/proc/self/fd"))
    for _ in range(5):
        with atomic_write(path) as temporary:
            temporary.write_text("new")
    assert len(os.listdir("/proc/self/fd")) == before
    assert path.read_text() == "new"
