"""What is written is read back: points bit for bit, and everything that is carried."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from hexmend import FileError, Mesh, io
from hexmend.io import FORMATS
from hexmend.io.base.format import Capability
from tests.core.grids import grid, scrambled

EXACT = [(one.suffixes[0], encoding) for one in FORMATS.values() if one.exact for encoding in one.encodings]
PINNED = [
    (one.suffixes[0], way)
    for one in FORMATS.values()
    if Capability.FIXED_NODES in one.capabilities
    for way in one.encodings
]


@pytest.mark.parametrize(
    ("suffix", "encoding"),
    [(one.suffixes[0], way) for one in FORMATS.values() if not one.place for way in one.encodings],
)
def test_a_file_that_is_cut_short_gives_a_mesh_or_one_clear_error(suffix, encoding, tmp_path):
    io.write(tmp_path / f"good{suffix}", scrambled(grid(2), 0.2), encoding=encoding)
    data, path = (tmp_path / f"good{suffix}").read_bytes(), tmp_path / f"bad{suffix}"
    for end in np.linspace(1, len(data) - 3, 24).astype(int):
        path.write_bytes(data[:end])
        try:
            assert io.read(path).n_hexes == 8
        except FileError as error:
            assert str(error).startswith(f"bad{suffix}: ")
            assert "\n" not in str(error)


@pytest.mark.slow
@pytest.mark.parametrize(("suffix", "encoding"), EXACT)
@given(points=arrays(np.float64, (8, 3), elements=st.floats(-1e70, 1e70)))
def test_every_finite_coordinate_survives(suffix, encoding, points, tmp_path_factory):
    path = tmp_path_factory.mktemp("one") / f"one{suffix}"
    points[:2] = [[0, 0, 0], [1, 1, 1]]  # it has a size
    mesh = Mesh(points, [range(8)])
    io.write(path, mesh, encoding=encoding)
    np.testing.assert_array_equal(io.read(path).points, mesh.points)


def test_a_fixed_array_pins_nodes_and_is_carried(tmp_path):
    fixed = np.zeros(64, np.int32)
    fixed[21] = 1
    io.write(tmp_path / "a.vtk", grid(3).replace(node_data={"fixed": fixed}))
    back = io.read(tmp_path / "a.vtk")
    assert back.fixed[21]
    assert back.free.sum() == 7
    np.testing.assert_array_equal(back.node_data["fixed"], fixed)


@pytest.mark.parametrize(("suffix", "encoding"), PINNED)
@pytest.mark.parametrize("pins", [[5, 37], []])
def test_pins_that_changed_after_reading_are_what_is_written(suffix, encoding, pins, tmp_path):
    io.write(tmp_path / f"a{suffix}", grid(3).replace(pinned=np.isin(np.arange(64), [5, 21])), encoding=encoding)
    mesh = io.read(tmp_path / f"a{suffix}")
    pinned = np.zeros(mesh.n_nodes, bool)
    pinned[pins] = True
    io.write(tmp_path / f"b{suffix}", mesh.replace(pinned=pinned), encoding=encoding)
    back = io.read(tmp_path / f"b{suffix}")
    np.testing.assert_array_equal(back.fixed, mesh.replace(pinned=pinned).fixed)


def test_references_of_a_medit_file_are_whole_numbers_however_round(tmp_path):
    mesh = grid(1)
    data = {"medit:ref": np.array([100000, 10**6, 7, 0, -300000, 1, 2, 10**9])}
    path = tmp_path / "round.mesh"
    io.write(path, Mesh(mesh.points, mesh.hexes, node_data=data))
    lines = path.read_text().splitlines()
    begin = lines.index("Vertices") + 2
    assert [int(line.split()[3]) for line in lines[begin : begin + 8]] == data["medit:ref"].tolist()
