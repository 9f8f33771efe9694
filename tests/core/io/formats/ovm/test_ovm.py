"""OpenVolumeMesh's files: hexes out of half-faces, whichever of its corners each begins with."""

import itertools

import numpy as np
import pytest

from hexmend import FileError, io, summarise
from hexmend.mesh.hexahedron import FACES, UNIT_CUBE
from tests.core.grids import grid


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
    (tmp_path / "a.ovm").write_text(written(mesh.points, mesh.hexes, seed=seed))
    found = io.read(tmp_path / "a.ovm")
    np.testing.assert_array_equal(np.sort(found.hexes, axis=1), np.sort(mesh.hexes, axis=1))
    assert summarise(found).q_min == pytest.approx(1)
    assert found.notes == ()


def test_properties_are_data(tmp_path):
    properties = (
        'VProp double "heat"\n' + "0.5\n" * 8 + 'HFProp int "odd"\n' + "3\n" * 12 + 'CProp vec3d "flow x"\n1 2 3\n'
    )
    properties += 'CProp int "id"\n7\n'
    (tmp_path / "a.ovm").write_text(written(UNIT_CUBE, np.arange(8)[None], properties))
    mesh = io.read(tmp_path / "a.ovm")
    assert mesh.node_data["heat"].tolist() == [0.5] * 8
    assert mesh.hex_data["flow x"].tolist() == [[1, 2, 3]]
    assert mesh.hex_data["id"].tolist() == [7]
    assert any("'odd'" in note for note in mesh.notes)


def test_other_polyhedra_are_left_out_and_said(tmp_path):
    text = written(UNIT_CUBE, np.arange(8)[None])
    head, cells = text.split("Polyhedra\n1\n")
    five = " ".join(cells.split()[1:6])
    (tmp_path / "a.ovm").write_text(f"{head}Polyhedra\n2\n5 {five}\n{cells}")
    mesh = io.read(tmp_path / "a.ovm")
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
