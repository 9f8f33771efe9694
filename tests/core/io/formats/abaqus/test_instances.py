"""Parts and instances of Abaqus, with sets and surfaces of the assembly."""

import numpy as np

from hexmend.mesh.hexahedron import UNIT_CUBE
from hexmend.quality import summarise
from tests.core.io.formats.abaqus.test_abaqus import cube, read

PARTS = f"""\
*PART, NAME=Brick
*NODE
{cube()}*ELEMENT, TYPE=C3D8, ELSET=Bulk
1, 1, 2, 3, 4, 5, 6, 7, 8
*NSET, NSET=Corner
1
*END PART
*PART, NAME=Unused
*END PART
*ASSEMBLY, NAME=Assembly
*INSTANCE, NAME=Brick-1, PART=Brick
*END INSTANCE
"""
SECOND = """\
*INSTANCE, NAME=Brick-2, PART=BRICK
5., 0., 0.
5., 0., 0., 5., 0., 1., 90.
*END INSTANCE
"""
ASSEMBLY = """\
*NSET, NSET=ends, INSTANCE=Brick-1
1, 7
*ELSET, ELSET=first, INSTANCE=Brick-1
Bulk
*SURFACE, NAME=face, TYPE=ELEMENT
Brick-1.Bulk, S1
*END ASSEMBLY
"""


def test_one_instance_of_a_part_is_the_mesh(tmp_path):
    mesh = read(PARTS + ASSEMBLY, tmp_path)
    assert set(mesh.node_sets) == {"Corner", "ends"}
    assert mesh.node_sets["ends"].tolist() == [0, 6]
    assert mesh.side_sets["face"].tolist() == [[0, 4]]
    assert any("1 part without an instance" in note for note in mesh.notes)


def test_several_instances_are_joined_at_their_placements(tmp_path):
    mesh = read(PARTS + SECOND + ASSEMBLY, tmp_path)
    assert mesh.n_hexes == 2
    assert any("2 instances" in note for note in mesh.notes)
    np.testing.assert_allclose(
        mesh.points[8:], UNIT_CUBE @ np.array([[0, 1, 0], [-1, 0, 0], [0, 0, 1]]) + [5, 0, 0], atol=1e-12
    )
    assert mesh.node_sets["Brick-2.Corner"].tolist() == [8]
    assert mesh.hex_sets["first"].tolist() == [0]
    assert summarise(mesh).inverted == 0


def meshed_instance(name, lift):
    """Instance with nodes and elements of its own, as Abaqus/CAE writes the mesh of an assembly."""
    nodes = "".join(f"{k}, {x:g}, {y:g}, {z + lift:g}\n" for k, (x, y, z) in enumerate(UNIT_CUBE, 1))
    upper = "".join(f"{k}, {x:g}, {y:g}, {z + lift + 1:g}\n" for k, (x, y, z) in enumerate(UNIT_CUBE[4:], 9))
    return f"""\
*INSTANCE, NAME={name}, PART=Empty
*NODE
{nodes}{upper}*ELEMENT, TYPE=C3D8R
1, 1, 2, 3, 4, 5, 6, 7, 8
2, 5, 6, 7, 8, 9, 10, 11, 12
*NSET, NSET=Picked, GENERATE
1, 12, 5
*ELSET, ELSET=Picked, INTERNAL, GENERATE
1, 2, 1
*SURFACE, NAME=Top, TYPE=ELEMENT
2, S2
*END INSTANCE
"""


ON_INSTANCES = """*NSET, NSET=ends, INSTANCE=A-1
1, 12
*ELSET, ELSET=_Sides_S3, INTERNAL, INSTANCE=A-1, GENERATE
1, 2, 1
*ELSET, ELSET=all, INSTANCE=A-1
Picked
*SURFACE, NAME=Sides, TYPE=ELEMENT
_Sides_S3, S3
A-1.Picked, S5
*END ASSEMBLY
"""


def test_sets_of_an_instance_with_its_own_mesh_are_found(tmp_path):
    head = "*PART, NAME=Empty\n*END PART\n*ASSEMBLY, NAME=Assembly\n"
    mesh = read(head + meshed_instance("A-1", 0) + ON_INSTANCES, tmp_path)
    assert mesh.notes == ()
    assert {name: members.tolist() for name, members in mesh.node_sets.items()} == {
        "Picked": [0, 5, 10], "ends": [0, 11],
    }  # fmt: skip
    assert {name: members.tolist() for name, members in mesh.hex_sets.items()} == {
        "Picked": [0, 1], "_Sides_S3": [0, 1], "all": [0, 1],
    }  # fmt: skip
    assert mesh.side_sets["Top"].tolist() == [[1, 5]]
    assert sorted(mesh.side_sets["Sides"][:, 0].tolist()) == [0, 0, 1, 1]

    two = read(head + meshed_instance("A-1", 0) + meshed_instance("B-1", 5) + ON_INSTANCES, tmp_path)
    assert not any("do not exist" in note for note in two.notes)
    assert two.node_sets["B-1.Picked"].tolist() == [12, 17, 22]
    assert two.hex_sets["all"].tolist() == [0, 1]
    assert two.side_sets["B-1.Top"].tolist() == [[3, 5]]


def test_data_of_an_instance_do_not_change_its_part(tmp_path):
    own = "*NSET, NSET=Corner\n7\n*NSET, NSET=New\nCorner, 2\n*END INSTANCE\n"
    mesh = read(PARTS.removesuffix("*END INSTANCE\n") + own + SECOND + ASSEMBLY, tmp_path)
    sets = {name: members.tolist() for name, members in mesh.node_sets.items()}
    assert sets == {
        "Brick-1.Corner": [0, 6], "Brick-1.New": [0, 1, 6], "Brick-2.Corner": [8], "ends": [0, 6],
    }  # fmt: skip
