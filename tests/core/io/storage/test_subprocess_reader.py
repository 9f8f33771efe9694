"""Reading in another process: what comes back, and what is said where nothing does."""

import numpy as np
import pytest

from hexmend.errors import FileError
from hexmend.io.base.content import Block, Content
from hexmend.io.storage.subprocess_reader import decode, encode, run_reader

READERS = """
import os, signal
from hexmend.errors import FileError
def dies(path): os.kill(os.getpid(), signal.SIGSEGV)
def fails(path): raise ZeroDivisionError
def refuses(path): raise FileError(path, "has a hole in it", "Mend it.")
def swallows(path): bytearray(1 << 50)
"""


def test_a_content_is_the_same_when_unpacked():
    one = Content(
        np.eye(3),
        (Block("hex", np.arange(8)[None], {"id": np.array([4])}, {"a b": np.array([0])}),),
        {"t": np.arange(3.0)},
        {"wall": np.array([1])},
        field_data={"title": ["made elsewhere"]},
        notes=("This was done.",),
    )
    arrays = {}
    other = decode(encode(one, arrays), arrays)
    np.testing.assert_array_equal(other.points, one.points)
    np.testing.assert_array_equal(other.blocks[0].nodes, one.blocks[0].nodes)
    assert other.blocks[0].data["id"].tolist() == [4]
    assert other.blocks[0].sets["a b"].tolist() == [0]
    assert other.notes == one.notes
    assert other.field_data == {"title": ["made elsewhere"]}


@pytest.mark.parametrize(
    ("reader", "words"),
    [
        ("dies", "ends the library that reads it"),
        ("fails", r"its reader fails \(ZeroDivisionError\)"),
        ("swallows", "needs more memory than"),
        ("refuses", r"^some\.dat: has a hole in it\. Mend it\.$"),
    ],
)
def test_whatever_the_reader_does_this_process_says_it(reader, words, tmp_path, monkeypatch):
    (tmp_path / "readers_that_fail.py").write_text(READERS)
    monkeypatch.syspath_prepend(tmp_path)
    (tmp_path / "some.dat").write_bytes(b"x")
    with pytest.raises(FileError, match=words):
        run_reader(f"readers_that_fail:{reader}", tmp_path / "some.dat")
