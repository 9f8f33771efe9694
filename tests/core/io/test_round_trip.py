"""What is written is read back: points bit for bit, and everything that is carried."""

import re
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from hexmend import FileError, Mesh, io, summarise
from hexmend.io import FORMATS
from hexmend.io.base.format import Capability
from tests.core.grids import grid, scrambled
from tests.core.io.kept import assert_same, middles_are_in_the_middle, read_back, read_content

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
    np.testing.assert_array_equal(read_back(path, mesh, encoding=encoding).points, mesh.points)


def test_a_fixed_array_pins_nodes_and_is_carried(tmp_path):
    fixed = np.zeros(64, np.int32)
    fixed[21] = 1
    back = read_back(tmp_path / "a.vtk", grid(3).replace(node_data={"fixed": fixed}))
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
    back = read_back(tmp_path / f"b{suffix}", mesh.replace(pinned=pinned), encoding=encoding)
    np.testing.assert_array_equal(back.fixed, mesh.replace(pinned=pinned).fixed)


def test_references_of_a_medit_file_are_whole_numbers_however_round(tmp_path):
    mesh = grid(1)
    data = {"medit:ref": np.array([100000, 10**6, 7, 0, -300000, 1, 2, 10**9])}
    path = tmp_path / "round.mesh"
    io.write(path, Mesh(mesh.points, mesh.hexes, node_data=data))
    lines = path.read_text().splitlines()
    begin = lines.index("Vertices") + 2
    assert [int(line.split()[3]) for line in lines[begin : begin + 8]] == data["medit:ref"].tolist()


# Files that Gmsh 4.15 and MEDCoupling 9.15 wrote of one mesh, in all formats: read completely, and written again.


FILES = Path(__file__).with_name("files")
#: Suffixes of decks that were made by hand.
DECKS = (".rad", ".feb", ".cdb")
NAMES = sorted(path.name for path in FILES.iterdir() if "fields" not in path.name and path.suffix not in DECKS)
ALL = {"vertex": {"origin": [0]}, "line": {"edge": [0]}, "triangle": {"bottom": [0]}}
ALL |= {"quad": {"floor": [0], "bottom": [0]}, "hex": {"block one": [0, 1]}}
#: Sets of each kind of cell, by suffix.
SETS = {
    ".msh": ALL | {"wedge": {"physical 3": [0, 1]}},
    ".med": ALL | {"wedge": {"G_3D_3": [0, 1]}},
    ".inp": {
        "line": {"Line1": [0], "edge": [0]},
        "quad": {"Surface1": [0], "floor": [0], "bottom": [0]},
        "triangle": {"Surface2": [0], "bottom": [0]},
        "wedge": {"Volume2": [0, 1], "PhysicalVolume3": [0, 1]},
        "hex": {"Volume1": [0, 1], "block_one": [0, 1]},
    },
    ".bdf": {kind: {"property 1": [0]} for kind in ("line", "quad")}
    | {"triangle": {"property 2": [0]}, "wedge": {"property 2": [0, 1]}, "hex": {"property 1": [0, 1]}},
    ".su2": {"wedge": {}, "quad": {"floor": [0], "bottom": [1]}, "triangle": {"bottom": [0]}, "hex": {}},
}


def in_lists(sets):
    return {name: members.tolist() for name, members in sets.items()}


@pytest.mark.parametrize("name", NAMES)
def test_it_is_read_completely_and_survives(name, tmp_path):
    mesh, suffix = io.read(FILES / name), Path(name).suffix
    order = {"o1": 8, "o2": 27}.get(re.split("[-.]", name)[1], 20)
    assert (mesh.n_hexes, mesh.n_nodes, summarise(mesh).inverted) == (2, {8: 15, 20: 43, 27: 60}[order], 0)
    np.testing.assert_allclose(mesh.points[mesh.hexes].mean(axis=1), [[0.5, 0.5, 0.25], [0.5, 0.5, 0.75]])
    assert order == 8 if mesh.mid_nodes is None else ((mesh.mid_nodes >= 0).sum(axis=1) == order - 8).all()
    middles_are_in_the_middle(mesh)
    expected = {kind: sets for kind, sets in SETS[suffix].items() if (kind, order) != ("wedge", 27)}
    found = {re.sub(r"\d+$", "", cells.kind): in_lists(cells.sets) for cells in mesh.cells}
    assert found | {"hex": in_lists(mesh.hex_sets)} == expected
    ids = [6, 7] if "2.2" in name else [5, 6]
    assert suffix == ".su2" or mesh.hex_data["id"].tolist() == ids
    for encoding in io.FORMATS[io.format_lookup.format_of(FILES / name).name].encodings:
        again = read_back(tmp_path / f"a{suffix}", mesh, encoding=encoding)
        assert_same(mesh, again, without=() if "id" in again.node_data and suffix != ".med" else ("ids",))
        groups = (sorted(one.field_data.get("gmsh:physical", [])) for one in (mesh, again))
        assert next(groups) == next(groups)


def test_both_versions_and_encodings_of_gmsh_give_the_same_mesh():
    first, other = (io.read(FILES / f"gmsh-o2i-4.1-{way}.msh") for way in "ba")
    np.testing.assert_allclose(first.points, other.points, rtol=1e-12)  # Gmsh writes 16 digits, of which some need 17
    assert_same(first, other.rebuilt(points=first.points))


def test_a_file_is_recognised_by_its_content(tmp_path):
    assert read_content(tmp_path / "a.inp", (FILES / "gmsh-o1-4.1-b.msh").read_bytes()).n_hexes == 2
