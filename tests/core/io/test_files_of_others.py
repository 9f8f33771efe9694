"""Files that Gmsh 4.15 and MEDCoupling 9.15 wrote of one mesh, in all formats: read completely, and written again."""

import re
from pathlib import Path

import numpy as np
import pytest

from hexmend import io, summarise
from tests.core.io.kept import assert_same, middles_are_in_the_middle

FILES = Path(__file__).with_name("files")
NAMES = sorted(path.name for path in FILES.iterdir() if "fields" not in path.name)
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
        io.write(tmp_path / f"a{suffix}", mesh, encoding=encoding)
        again = io.read(tmp_path / f"a{suffix}")
        assert_same(mesh, again, without=() if "id" in again.node_data and suffix != ".med" else ("ids",))
        groups = (sorted(one.field_data.get("gmsh:physical", [])) for one in (mesh, again))
        assert next(groups) == next(groups)


def test_both_versions_and_encodings_of_gmsh_give_the_same_mesh():
    first, other = (io.read(FILES / f"gmsh-o2i-4.1-{way}.msh") for way in "ba")
    np.testing.assert_allclose(first.points, other.points, rtol=1e-12)  # Gmsh writes 16 digits, of which some need 17
    assert_same(first, other.rebuilt(points=first.points))


def test_a_file_is_recognised_by_its_content(tmp_path):
    (tmp_path / "a.inp").write_bytes((FILES / "gmsh-o1-4.1-b.msh").read_bytes())
    assert io.read(tmp_path / "a.inp").n_hexes == 2
