"""Memory while reading: little more than the arrays of the mesh, for each large format."""

import tracemalloc

import pytest

from hexmend.gallery import make
from hexmend.io import read, write

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
