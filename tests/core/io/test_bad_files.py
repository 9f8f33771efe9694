"""Bad files: one clear error that names file, place and remedy; whatever is cut or flipped, never another failure.

Some spoilt files of every format; `scripts/fuzz_readers.py` reads thousands, and larger ones.

Memory while reading: little more than the arrays of the mesh, for each large format.
"""

import bz2
import gzip
import lzma
import os
import tracemalloc
from pathlib import Path

import numpy as np
import pytest

from hexmend import FileError, io
from hexmend.gallery import make
from hexmend.io import FORMATS, read, write
from hexmend.io.storage.atomic import atomic_write
from tests.core.grids import grid, scrambled
from tests.programs import run_python


def test_a_missing_file_is_said_with_its_nearest(tmp_path):
    io.write(tmp_path / "bridge.vtk", grid(1))
    with pytest.raises(FileError, match=r"Did you mean bridge\.vtk"):
        io.read(tmp_path / "brigde.vtk")
    with pytest.raises(FileError, match="is a folder"):
        io.read(tmp_path)


def test_a_write_replaces_the_file_with_the_users_permissions(tmp_path):
    path = tmp_path / "new.vtk"
    with atomic_write(path) as temporary:
        assert temporary.parent == tmp_path
        assert temporary.suffix == ".vtk"
        temporary.write_text("new")
    assert path.read_text() == "new"
    mask = os.umask(0)
    os.umask(mask)
    assert path.stat().st_mode & 0o777 == 0o666 & ~mask


@pytest.mark.parametrize("name", ["no/such/folder/a.vtk", "a.xyz"])
def test_targets_that_cannot_be_written_are_said(name, tmp_path):
    with pytest.raises(FileError):
        io.write(tmp_path / name, grid(1))
    assert os.listdir(tmp_path) == []


@pytest.mark.parametrize("suffix", [".inp", ".msh", ".mesh", ".bdf", ".su2", ".vtk", ".ovm"])
def test_a_byte_order_mark_is_no_part_of_the_text(suffix, tmp_path):
    path, mesh = tmp_path / f"a{suffix}", scrambled(grid(2), 0.2)
    io.write(path, mesh, encoding="ascii")
    text = path.read_bytes()
    if suffix == ".inp":
        text = text[text.index(b"*NODE") :]  # a heading before it would be lost with the mark, unnoticed
    path.write_bytes(b"\xef\xbb\xbf" + text)
    given = io.read(path)
    assert given.n_hexes == 8
    if FORMATS[io.format_lookup.format_of(path).name].locate is not None:
        io.write(tmp_path / f"b{suffix}", given.with_points(given.points + 1), like=path)
        np.testing.assert_allclose(io.read(tmp_path / f"b{suffix}").points, given.points + 1, rtol=1e-12)


@pytest.mark.parametrize(
    "name", [*(f"a{one.suffixes[0]}" for one in FORMATS.values() if one.write and not one.place), "a.vtk.gz"]
)
def test_compressed_files_are_called_compressed_whatever_their_names(name, tmp_path):
    for compress, program in ((gzip.compress, "gzip"), (bz2.compress, "bzip2"), (lzma.compress, "xz")):
        (tmp_path / name).write_bytes(compress(b"anything"))
        with pytest.raises(FileError, match=f"is compressed by {program}. Decompress it first."):
            io.read(tmp_path / name)


SCRIPT = Path(__file__).resolve().parents[3] / "scripts/fuzz_readers.py"

#: Formats of which each file is read in a process of its own, which takes its time.
APART = ["med", "vtkhdf"]


@pytest.mark.parametrize(("names", "cases"), [
    ([*(name for name in FORMATS if name not in APART), "session"], 50), (APART, 4),
], ids=["here", "apart"])  # fmt: skip
@pytest.mark.slow
def test_a_spoilt_file_gives_a_mesh_or_one_clear_error(names, cases):
    words = ["--cases", str(cases), "--seed", "7", "--meshes", str(Path(__file__).with_name("files")), *names]
    done = run_python(SCRIPT, *words)
    assert done.returncode == 0, done.stderr
    assert all(f"{name} " in done.stdout for name in names)


#: Arrays of the mesh that reading may take, and bytes of blocks that are read at a time besides.
ARRAYS, BLOCKS = 2.5, 2 << 20
SIZE = 120_000


@pytest.fixture(scope="module")
def mesh():
    return make("five-side", size=SIZE, scramble=0.3)


def peak_of_reading(path):
    """Peak of the memory of this process in reading a file, bytes, and the mesh."""
    tracemalloc.start()
    try:
        mesh = read(path)
        return tracemalloc.get_traced_memory()[1], mesh
    finally:
        tracemalloc.stop()


@pytest.mark.parametrize("suffix", [".vtu", ".vtkhdf", ".vtk", ".meshb", ".msh", ".exo"])
def test_a_binary_file_takes_two_and_a_half_times_the_arrays_of_its_mesh_at_most(mesh, tmp_path, suffix):
    write(tmp_path / f"mesh{suffix}", mesh)
    peak, found = peak_of_reading(tmp_path / f"mesh{suffix}")
    arrays = found.points.nbytes + found.hexes.nbytes
    assert (found.hexes == mesh.hexes).all()
    assert (found.points == mesh.points).all()
    assert peak < ARRAYS * arrays + BLOCKS, f"{peak / arrays:.1f} times its arrays"
