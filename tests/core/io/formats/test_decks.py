"""Decks of Radioss, FEBio and Ansys, and universal files: read, and written as copies with other coordinates; what is wrong is named."""

from pathlib import Path

import numpy as np
import pytest

from hexmend import FileError, io
from hexmend.mesh.hexahedron import FACES, UNIT_CUBE
from hexmend.mesh.second_order import MID_NODE_POSITIONS
from tests.core.grids import grid
from tests.core.io.kept import (
    assert_refused,
    assert_same,
    middles_are_in_the_middle,
    read_back,
    read_content,
    with_everything,
)

FILES = Path(__file__).parents[1] / "files"
DECKS = {suffix: (FILES / f"two-hexes{suffix}").read_text() for suffix in (".rad", ".feb", ".cdb")}
#: Names of the parts or materials, and of the set of all nodes at the bottom, in each deck.
NAMES = {
    ".rad": (["left", "right"], "base"),
    ".feb": (["left & low", "right"], "base"),
    ".cdb": (["material 1", "material 2"], "BASE"),
}


@pytest.mark.parametrize("suffix", DECKS)
def test_nodes_hexes_parts_and_sets_are_read(suffix):
    mesh = io.read(FILES / f"two-hexes{suffix}")
    parts, base = NAMES[suffix]
    assert mesh.points[[0, 5, 11]].tolist() == [[0, 0, 0], [2, 1, 0], [2, 1, 1]]
    assert mesh.hexes.tolist() == [[0, 1, 4, 3, 6, 7, 10, 9], [1, 2, 5, 4, 7, 8, 11, 10]]
    assert mesh.hex_data["id"].tolist() == [5, 6]
    assert [mesh.hex_sets[name].tolist() for name in parts] == [[0], [1]]
    assert mesh.node_sets[base].tolist() == [0, 1, 2, 3, 4, 5]
    assert [rows.tolist() for name, rows in mesh.hex_sets.items() if name.lower() == "one"] == [[1]]
    if suffix != ".cdb":  # which has shells as numbers of types alone
        assert [(one.kind, one.nodes.tolist()) for one in mesh.cells] == [("quad", [[0, 1, 4, 3]])]
        ((hexa, face),) = mesh.side_sets["load"]
        assert (hexa, sorted(mesh.hexes[0][FACES[face]])) == (0, [0, 1, 3, 4])
    assert np.flatnonzero(mesh.pinned).tolist() == ([0, 1, 3, 4, 11] if suffix == ".cdb" else [1, 11])
    assert mesh.field_data["contact cards"]


@pytest.mark.parametrize("suffix", DECKS)
def test_a_deck_is_written_as_a_copy_alone(suffix, tmp_path):
    source, mesh = FILES / f"two-hexes{suffix}", io.read(FILES / f"two-hexes{suffix}")
    with pytest.raises(FileError, match="is written as a copy of a deck"):
        io.write(tmp_path / f"b{suffix}", mesh)
    changed = mesh.replace(node_sets={})
    with pytest.raises(FileError, match="other node sets"):
        io.write_as_given(tmp_path / f"b{suffix}", changed, io.Original(source, mesh))


def columns(numbers, width=10):
    return "".join(f"{one:{width}d}" for one in numbers)


def second_order(suffix, order):
    """A deck of one hex of 20 nodes, whose mid-nodes the format has in some order of VTK's."""
    points = np.concatenate([UNIT_CUBE, MID_NODE_POSITIONS[:12]])
    nodes = np.arange(1, 21)[order]
    if suffix == ".rad":
        rows = "\n".join(f"{k:10d}" + "".join(f"{x:20.6f}" for x in p) for k, p in enumerate(points, 1))
        lines = (columns([7, *nodes[:8]]), " " * 10 + columns(nodes[8:16]), " " * 10 + columns(nodes[16:]))
        return f"/BEGIN\n/NODE\n{rows}\n/BRIC20/1\n" + "\n".join(lines) + "\n/END\n"
    if suffix == ".feb":
        rows = "".join(f"<node id='{k}'>{x},{y},{z}</node>" for k, (x, y, z) in enumerate(points, 1))
        text = f"<elem id='7'>{','.join(map(str, nodes))}</elem>"
        return f"<febio_spec><Nodes>{rows}</Nodes><Elements type='hex20'>{text}</Elements></febio_spec>"
    rows = "\n".join(f"{columns([k, 0, 0], 8)}" + "".join(f"{x:16.8e}" for x in p) for k, p in enumerate(points, 1))
    lines = columns([1, 1, 1, 1, 0, 0, 0, 0, 20, 0, 7, *nodes[:8]], 8), columns(nodes[8:], 8)
    head = f"/PREP7\nET,1,SOLID186\nNBLOCK,6,SOLID\n(3i8,6e16.8)\n{rows}\nN,R5.3,LOC,-1,\nEBLOCK,19,SOLID\n(19i8)\n"
    return head + "\n".join(lines) + "\n      -1\nFINISH\n"


VERTICAL_FIRST = [*range(12), 16, 17, 18, 19, 12, 13, 14, 15]


def test_what_a_universal_file_holds_is_read_again(tmp_path):
    for order in (8, 20):
        mesh = with_everything(order)
        back = read_back(tmp_path / "a.unv", mesh)
        kept = [cells for cells in mesh.cells if cells.kind != "pyramid"]
        assert_same(back, mesh.replace(cells=tuple(kept)), without=("side_sets",))
        moved = back.with_points(back.points / 3)
        io.write(tmp_path / "b.unv", moved, like=tmp_path / "a.unv")
        np.testing.assert_array_equal(io.read(tmp_path / "b.unv").points, moved.points)
        given, new = ((tmp_path / name).read_text().splitlines() for name in ("a.unv", "b.unv"))
        assert len(given) == len(new)
        assert sum(a != b for a, b in zip(given, new, strict=True)) <= mesh.n_nodes


def test_what_is_wrong_in_a_universal_file_is_named(tmp_path):
    """Nodes of elements that are not read stay; those have the lines of beams where they are such."""
    io.write(tmp_path / "a.unv", grid(2))
    text, head = (tmp_path / "a.unv").read_text(), columns([1, 115, 1, 1, 7, 8])
    mesh = read_content(tmp_path / "b.unv", text.replace(head, columns([1, 199, 1, 1, 7, 8])))
    assert (mesh.n_hexes, mesh.pinned.sum()) == (7, 8)
    assert_refused(tmp_path / "c.unv", "FE descriptor 115 without 8 nodes", text.replace(head, head[:-1] + "7"))
    assert_refused(tmp_path / "d.unv", "dataset 2412 in line 60 holds 'x ", text.replace(head, "x" + head[1:]))


@pytest.mark.parametrize(("suffix", "order"), [(".rad", VERTICAL_FIRST), (".feb", range(20)), (".cdb", range(20))])
def test_mid_nodes_are_in_the_middle(suffix, order, tmp_path):
    mesh = read_content(tmp_path / f"a{suffix}", second_order(suffix, list(order)))
    assert (mesh.n_hexes, (mesh.mid_nodes >= 0).sum()) == (1, 12)
    middles_are_in_the_middle(mesh)
    io.write(tmp_path / f"b{suffix}", mesh.with_points(2 * mesh.points), like=tmp_path / f"a{suffix}")
    np.testing.assert_allclose(io.read(tmp_path / f"b{suffix}").points, 2 * mesh.points, rtol=1e-12)


def test_collapsed_solids_of_ansys_are_of_second_order_too(tmp_path):
    """A hex of 20 nodes with I J K K M N O O is a wedge, with I J K K M M M M a tetrahedron."""
    text = second_order(".cdb", list(range(20)))
    given = columns(range(1, 9), 8) + "\n" + columns(range(9, 21), 8)
    forms = {
        "wedge15": columns([1, 2, 3, 3, 5, 6, 7, 7, 9, 10, 3, 12, 13, 14, 7, 16, 17, 18, 19, 19], 8),
        "pyramid13": columns([1, 2, 3, 4, 5, 5, 5, 5, 9, 10, 11, 12, 5, 5, 5, 5, 17, 18, 19, 20], 8),
        "tetra10": columns([1, 2, 3, 3, 5, 5, 5, 5, 9, 10, 3, 12, 5, 5, 5, 5, 17, 18, 19, 19], 8),
    }
    for kind, row in forms.items():
        mesh = read_content(tmp_path / "a.cdb", text.replace(given, row[:64] + "\n" + row[64:]))
        assert [(cells.kind, len(cells.nodes)) for cells in mesh.cells] == [(kind, 1)]


@pytest.mark.parametrize(("suffix", "old", "new", "words"), [
    (".rad", "        11    0.0", "        1x    0.0", "/NODE in line 16 holds '1x': expected a whole number"),
    (".rad", "        11        12        15", "        99        12        15", "node 99 is used"),
    (".rad", "        11        12        15        14        17", "        11        12        15", "1 element of another number"),
    (".rad", "/NODE\n", "/NODES\n", "has no /NODE"),
    (".rad", "/MAT", "#include b.rad\n/MAT", "#include in line 8 of a.rad reads 'b.rad', which does not exist"),
    (".feb", "0, 0, 0<", "0, y, 0<", "<Nodes> in line 7 holds 'y': expected a number"),
    (".feb", ">1,2,5,4,7", ">1,2,5,4,99", "node 99 is used"),
    (".feb", "<Mesh>", '<Mesh from="b.feb">', "has its mesh in 'b.feb'. Open that file."),
    (".feb", "<Nodes name", "<Points name", "has no <Nodes>"),
    (".cdb", "        1        0        0", "        x        0        0", "NBLOCK in line 10 holds 'x'"),
    (".cdb", "(3i9,6e21.13e3)", "(none)", "NBLOCK in line 8 has no format"),
    (".cdb", "        8        0        5", "        7        0        5", "solids of other than 4, 8, 10 or 20 nodes"),
])  # fmt: skip
def test_what_is_wrong_is_named(suffix, old, new, words, tmp_path):
    assert old in DECKS[suffix]
    assert_refused(tmp_path / f"a{suffix}", words, DECKS[suffix].replace(old, new))
