"""Partitioned meshes of Gmsh."""

import numpy as np
import pytest

from hexmend import io
from tests.core.grids import grid


def partitioned(version, binary):
    """Three cubes in a row, each in a partition of its own, with a face on top of each; the last is in two groups."""
    mesh = grid(3, 1, 1)
    named = '$PhysicalNames\n3\n2 8 "in"\n3 7 "vol"\n3 9 "end"\n$EndPhysicalNames\n'
    if version == 2:
        nodes = "".join(f"{k} {x} {y} {z}\n" for k, (x, y, z) in enumerate(mesh.points.tolist(), 1))
        rows = [f"{k + 1} 3 4 8 1 1 {k + 1}" for k in range(3)], [f"{k + 4} 5 4 7 1 1 {k + 1}" for k in range(3)]
        rows[1][2] = "6 5 5 7 1 2 3 -1"
        cells = [*zip(rows[0], mesh.hexes[:, 4:], strict=True), *zip(rows[1], mesh.hexes, strict=True)]
        lines = "".join(f"{head} {' '.join(str(n + 1) for n in own)}\n" for head, own in cells)
        text = f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n{named}$Nodes\n16\n{nodes}$EndNodes\n$Elements\n6\n{lines}$EndElements\n"
        return text.encode()

    def put(code, *values):
        return np.array(values, f"<{code}").tobytes() if binary else " ".join(map(str, values)).encode() + b"\n"

    box = put("f8", 0, 0, 0, 3, 1, 1)
    volume = put("i4", 1) + box + put("u8", 1) + put("i4", 7) + put("u8", 0)
    surface = put("i4", 1) + box + put("u8", 1) + put("i4", 8) + put("u8", 0)
    entities = put("u8", 0, 0, 1, 1) + surface + volume
    parts = put("u8", 3) + put("u8", 1) + put("i4", 99, 2) + put("u8", 0, 0, 4, 3)
    for dimension, groups in ((2, ((), (), ())), (3, ((), (7,), (7, 9)))):  # those without have their parent's
        for k, own in enumerate(groups):
            parts += put("i4", 11 + k, dimension, 1) + put("u8", 1) + put("i4", k + 1) + box
            parts += put("u8", len(own)) + (put("i4", *own) if own else b"") + put("u8", 1) + put("i4", 5)
        if dimension == 2:  # where two parts of the volume meet
            parts += put("i4", 14, 3, 1) + put("u8", 2) + put("i4", 1, 2) + box + put("u8", 0) + put("u8", 0)
    nodes = put("u8", 1, 16, 1, 16) + put("i4", 3, 11, 0) + put("u8", 16) + put("u8", *range(1, 17))
    nodes += put("f8", *mesh.points.ravel().tolist())
    cells = put("u8", 6, 6, 1, 6)
    for k in range(3):
        cells += put("i4", 2, 11 + k, 3) + put("u8", 1) + put("u8", k + 1, *(mesh.hexes[k, 4:] + 1).tolist())
    for k in range(3):
        cells += put("i4", 3, 11 + k, 5) + put("u8", 1) + put("u8", k + 4, *(mesh.hexes[k] + 1).tolist())
    one = np.array([1], "<i4").tobytes() + b"\n" if binary else b""
    answer = b"$MeshFormat\n4.1 %d 8\n%s$EndMeshFormat\n" % (binary, one) + named.encode()
    sections = {b"Entities": entities, b"PartitionedEntities": parts, b"Nodes": nodes, b"Elements": cells}
    for name, content in sections.items():
        answer += b"$%s\n%s%s$End%s\n" % (name, content, b"\n" if binary else b"", name)
    return answer


@pytest.mark.parametrize(("version", "binary"), [(2, False), (4, False), (4, True)])
def test_a_partitioned_mesh_keeps_its_groups_and_the_partition_of_each_cell(version, binary, tmp_path):
    (tmp_path / "a.msh").write_bytes(partitioned(version, binary))
    mesh = io.read(tmp_path / "a.msh")
    (quads,) = mesh.cells
    assert mesh.hex_sets["vol"].tolist() == [0, 1, 2]
    assert quads.sets["in"].tolist() == [0, 1, 2]
    assert version == 2 or mesh.hex_sets["end"].tolist() == [2]
    assert mesh.hex_data["partition"].tolist() == [1, 2, 3]
    assert quads.data["partition"].tolist() == [1, 2, 3]
    assert any("The mesh is partitioned" in note for note in mesh.notes)
    io.write(tmp_path / "b.msh", mesh)
    again = io.read(tmp_path / "b.msh")
    assert again.hex_data["partition"].tolist() == [1, 2, 3]
    assert again.hex_sets.keys() == mesh.hex_sets.keys()


@pytest.mark.parametrize("own", [[], [b"partition_2"]], ids=["partition", "both"])
def test_data_named_partition_are_kept_together_with_the_partition_numbers(own, tmp_path):
    data = b"".join(
        b'$ElementData\n1\n"%s"\n1\n0\n3\n0\n1\n3\n4 42\n5 43\n6 44\n$EndElementData\n' % name
        for name in [b"partition", *own]
    )
    (tmp_path / "a.msh").write_bytes(partitioned(2, False) + data)
    mesh = io.read(tmp_path / "a.msh")
    title = "partition_3" if own else "partition_2"
    assert mesh.hex_data["partition"].tolist() == [42, 43, 44]
    assert mesh.hex_data[title].tolist() == [1, 2, 3]
    assert any(f"the cell data {title!r} hold" in note for note in mesh.notes)
    io.write(tmp_path / "b.msh", mesh)
    assert io.read(tmp_path / "b.msh").hex_data[title].tolist() == [1, 2, 3]
