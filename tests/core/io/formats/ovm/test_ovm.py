"""OpenVolumeMesh's files: hexes out of half-faces, whichever of its corners each begins with."""

import itertools
from collections import Counter

import numpy as np
import pytest

from hexmend import FileError, Mesh, io, summarise
from hexmend.mesh.hexahedron import FACES, UNIT_CUBE
from tests.core.grids import grid
from tests.core.io.kept import read_back, read_content


def written(points, hexes, properties="", seed=0) -> str:
    """The text of a file whose edges and faces go round as chance has it, and the cells' half-faces as they must."""
    chance = np.random.default_rng(seed)
    edges, faces, cells = {}, {}, []
    for nodes in hexes:
        sides = []
        for face in chance.permutation(6):
            loop = [int(node) for node in np.roll(nodes[FACES[face]][::-1], chance.integers(4))]  # from inside
            key = tuple(sorted(loop))
            if key not in faces:
                kept = loop if chance.random() < 0.5 else loop[::-1]
                around = []
                for a, b in itertools.pairwise([*kept, kept[0]]):
                    pair = (min(a, b), max(a, b))
                    edges.setdefault(pair, (len(edges), (a, b) if chance.random() < 0.5 else (b, a)))
                    number, direction = edges[pair]
                    around.append(2 * number + (direction != (a, b)))
                faces[key] = (len(faces), kept, around)
            number, kept, _ = faces[key]
            same = any(np.array_equal(np.roll(kept, k), loop) for k in range(4))
            sides.append(2 * number + (not same))
        cells.append(sides)

    def rows(values):
        return f"{len(values)}\n" + "".join(" ".join(map(str, row)) + "\n" for row in values)

    return (
        "OVM ASCII\nVertices\n" + rows(points.tolist())
        + "Edges\n" + rows([direction for _, direction in edges.values()])
        + "Faces\n" + rows([[4, *around] for _, _, around in faces.values()])
        + "Polyhedra\n" + rows([[6, *sides] for sides in cells]) + properties
    )  # fmt: skip


@pytest.mark.parametrize("seed", range(2))
def test_hexes_are_found_in_half_faces(seed, tmp_path):
    mesh = grid(3, 2, 2)
    found = read_content(tmp_path / "a.ovm", written(mesh.points, mesh.hexes, seed=seed))
    np.testing.assert_array_equal(np.sort(found.hexes, axis=1), np.sort(mesh.hexes, axis=1))
    assert summarise(found).q_min == pytest.approx(1)
    assert found.notes == ()


def test_properties_are_data(tmp_path):
    properties = (
        'VProp double "heat"\n' + "0.5\n" * 8 + 'HFProp int "odd"\n' + "3\n" * 12 + 'CProp vec3d "flow x"\n1 2 3\n'
    )
    properties += 'CProp int "id"\n7\n'
    mesh = read_content(tmp_path / "a.ovm", written(UNIT_CUBE, np.arange(8)[None], properties))
    assert mesh.node_data["heat"].tolist() == [0.5] * 8
    assert mesh.hex_data["flow x"].tolist() == [[1, 2, 3]]
    assert mesh.hex_data["id"].tolist() == [7]
    assert any("'odd'" in note for note in mesh.notes)


def test_other_polyhedra_are_left_out_and_said(tmp_path):
    text = written(UNIT_CUBE, np.arange(8)[None])
    head, cells = text.split("Polyhedra\n1\n")
    five = " ".join(cells.split()[1:6])
    mesh = read_content(tmp_path / "a.ovm", f"{head}Polyhedra\n2\n5 {five}\n{cells}")
    assert mesh.n_hexes == 1
    assert mesh.notes == ("Not read: 1 polyhedron of another kind.",)
    (tmp_path / "a.ovm").write_text(f"{head}Polyhedra\n1\n5 {five}\n")
    with pytest.raises(FileError, match="holds no hexahedra, but 1 other polyhedra"):
        io.read(tmp_path / "a.ovm")


@pytest.mark.parametrize(("prop", "section"), [("VProp", "Vertices"), ("CProp", "Polyhedra")])
def test_properties_of_what_is_not_there_yet_are_refused(prop, section, tmp_path):
    path = tmp_path / "a.ovm"
    io.write(path, grid(2))
    path.write_text(path.read_text().replace(section, f'{prop} double "x"\n{section}', 1))
    with pytest.raises(FileError, match=f"{prop}.* precedes {section}"):
        io.read(path)


# OpenVolumeMesh's files as they are written: half-faces as the library orders them, and all of it read again.


UNIT = """OVM ASCII
Vertices
8
0 0 0
1 0 0
1 1 0
0 1 0
0 0 1
1 0 1
1 1 1
0 1 1
Edges
12
"""


def section(path, name):
    """The rows of a section of a file, each a list of int."""
    found = path.read_text().split(f"\n{name}\n")[1].splitlines()
    return [[int(word) for word in line.split()] for line in found[1 : 1 + int(found[0])]]


def loops(path):
    """The nodes of each cell's half-faces, in order."""
    edges, faces = section(path, "Edges"), section(path, "Faces")
    around = [[edges[half >> 1][half & 1] for half in face[1:]] for face in faces]
    return [[around[half >> 1][:: -1 if half & 1 else 1] for half in cell[1:]] for cell in section(path, "Polyhedra")]


def test_a_hex_is_written_as_the_library_has_its_own(tmp_path):
    io.write(tmp_path / "a.ovm", Mesh(UNIT_CUBE, np.arange(8)[None]))
    assert (tmp_path / "a.ovm").read_text().startswith(UNIT)
    (sides,) = loops(tmp_path / "a.ovm")
    for one, other in ((0, 1), (2, 3), (4, 5)):
        assert not set(sides[one]) & set(sides[other])  # opposite
    crossed = []
    for start, stop in zip(sides[0], np.roll(sides[0], -1).tolist(), strict=True):  # round the first
        pairs = [zip(side, np.roll(side, -1).tolist(), strict=True) for side in sides]
        crossed += [k for k, edges in enumerate(pairs) if (stop, start) in edges]
    place = crossed.index(2)
    assert crossed[place:] + crossed[:place] == [2, 4, 3, 5]


def test_every_edge_and_face_is_there_once_and_shared(tmp_path):
    io.write(tmp_path / "a.ovm", grid(3, 2, 2))
    edges, faces = section(tmp_path / "a.ovm", "Edges"), section(tmp_path / "a.ovm", "Faces")
    assert len({frozenset(edge) for edge in edges}) == len(edges) == 3 * 9 + 4 * 2 * 3 * 2
    assert len(faces) == 3 * 2 * 3 * 2 + 4 * 2 * 2
    uses = Counter(half for cell in section(tmp_path / "a.ovm", "Polyhedra") for half in cell[1:])
    assert set(uses.values()) == {1}  # a half-face belongs to one cell


def test_a_real_file_is_written_with_its_own_edges_and_faces(real_mesh, tmp_path):
    path = real_mesh("Cylinder.ovm")
    mesh = io.read(path)
    again = read_back(tmp_path / "a.ovm", mesh)
    np.testing.assert_array_equal(again.hexes, mesh.hexes)
    np.testing.assert_array_equal(again.points, mesh.points)
    for name in ("Edges", "Faces", "Polyhedra"):
        assert len(section(tmp_path / "a.ovm", name)) == len(section(path, name))
    assert {frozenset(edge) for edge in section(path, "Edges")} == {
        frozenset(edge) for edge in section(tmp_path / "a.ovm", "Edges")
    }

    def cells(file):
        """The loops of each cell, from wherever they begin."""
        return [{tuple(np.roll(loop, -int(np.argmin(loop)))) for loop in cell} for cell in loops(file)]

    assert cells(tmp_path / "a.ovm") == cells(path)


def test_corners_stay_as_they_were_though_hexes_share_their_bases(tmp_path):
    mesh = grid(1, 1, 2)
    turned = [3, 2, 1, 0, 7, 6, 5, 4]  # about the axis x, and then about z
    hexes = np.array([mesh.hexes[0][[4, 7, 6, 5, 0, 3, 2, 1]], np.roll(mesh.hexes[1].reshape(2, 4), 1, axis=1).ravel()])
    for rows in (hexes, hexes[:, turned]):  # the latter inside out
        io.write(tmp_path / "a.ovm", Mesh(mesh.points, rows))
        np.testing.assert_array_equal(io.read(tmp_path / "a.ovm", as_is=True).hexes, rows)


def test_what_the_format_has_no_type_for_is_named(tmp_path):
    mesh = grid(1).replace(
        node_data={"tensor": np.zeros((8, 9)), "large": np.full((8, 2), 2**40), 'a"b': np.ones(8), "a'b": np.zeros(8)}
    )
    assert io.unsupported_data(tmp_path / "a.ovm", mesh) == [
        "point data of more than 4 columns, or no numbers (large, tensor)",
        'names of point data and sets as they are (a"b)',
    ]
    back = read_back(tmp_path / "a.ovm", mesh)
    assert {name: values[0] for name, values in back.node_data.items()} == {"a'b 2": 1, "a'b": 0}


def test_a_hex_with_a_node_twice_is_refused(tmp_path):
    with pytest.raises(FileError, match="hex 1 has a node twice"):
        io.write(tmp_path / "a.ovm", Mesh(grid(2, 1, 1).points, [[*range(8)], [1, 1, 2, 3, 4, 5, 6, 7]]))
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("number", [2**31 - 1, 2**31, 2**63 - 1, -(2**31), -(2**31) - 1, -(2**63)])
def test_whole_numbers_of_64_bits_are_kept(number, tmp_path):
    mesh = grid(2).replace(hex_data={"key": np.array([number, *range(7)], np.int64)})
    assert io.unsupported_data(tmp_path / "a.ovm", mesh) == []
    io.write(tmp_path / "a.ovm", mesh)
    kind = "int" if -(2**31) <= number < 2**31 else "long"
    assert f'CProp {kind} "key"' in (tmp_path / "a.ovm").read_text()
    np.testing.assert_array_equal(io.read(tmp_path / "a.ovm").hex_data["key"], mesh.hex_data["key"])


def test_greater_numbers_are_said_to_be_lost(tmp_path):
    mesh = grid(2).replace(hex_data={"key": np.array([0] * 7 + [2**63], np.uint64)})
    assert io.unsupported_data(tmp_path / "a.ovm", mesh)
