"""Reading in another process: what comes back, and what is said where nothing does."""

import pytest

from hexmend.errors import FileError
from hexmend.io.storage.subprocess_reader import run_reader

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
