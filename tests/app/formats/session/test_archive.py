"""Trees of plain data and arrays in one file: as they were, and nothing but data is ever taken from a file."""

import io
import json
import tracemalloc
import zipfile

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend.errors import FileError
from hexmend_app.formats.session.archive import DESCRIPTION, read_archive, write_archive

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
