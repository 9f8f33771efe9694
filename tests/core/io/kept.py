"""A mesh with all that a format may hold, and whether it came through."""

from pathlib import Path

import numpy as np
import pytest

from hexmend import Cells, FileError, Mesh, io
from hexmend.mesh.second_order import MID_NODE_POSITIONS, MID_NODE_WEIGHTS
from tests.core.grids import grid, scrambled

#: Edges of the cells of second order whose middles are the nodes behind their corners, as VTK orders them.
MIDDLES = {
    "line3": [(0, 1)],
    "triangle6": [(0, 1), (1, 2), (2, 0)],
    "quad8": [(0, 1), (1, 2), (2, 3), (3, 0)],
    "quad9": [(0, 1), (1, 2), (2, 3), (3, 0), (0, 1, 2, 3)],
    "tetra10": [(0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3)],
    "pyramid13": [(0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (1, 4), (2, 4), (3, 4)],
    "wedge15": [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)],
}
CORNERS = {"line3": 2, "triangle6": 3, "quad8": 4, "quad9": 4, "tetra10": 4, "pyramid13": 5, "wedge15": 6}


def middles_are_in_the_middle(mesh: Mesh) -> None:
    """Fail unless nodes of second order lie where their places in the cell say; of cells with straight edges."""
    if mesh.mid_nodes is not None:
        corners = mesh.points[mesh.hexes]
        for k in range(len(MID_NODE_POSITIONS)):
            there = mesh.mid_nodes[:, k] >= 0
            expected = np.einsum("c,hcx->hx", MID_NODE_WEIGHTS[k], corners[there])
            np.testing.assert_allclose(mesh.points[mesh.mid_nodes[there, k]], expected, atol=1e-9)
    for cells in mesh.cells:
        for k, ends in enumerate(MIDDLES.get(cells.kind, ())):
            expected = np.mean([mesh.points[cells.nodes[:, i]] for i in ends], axis=0)
            np.testing.assert_allclose(mesh.points[cells.nodes[:, CORNERS[cells.kind] + k]], expected, atol=1e-9)


def with_everything(second_order: int = 8) -> Mesh:
    """Hexes of 8, 20 or 27 nodes with ids, sets of nodes, hexes and sides, and cells of other kinds with sets."""
    bare = scrambled(grid(2, 2, 3), 0.2)
    m, n = bare.n_hexes, bare.n_nodes
    points, mids = bare.points, None
    if second_order > 8:
        mids = np.full((m, 19), -1, np.int32)
        mids[:, : second_order - 8] = n + np.arange(m * (second_order - 8)).reshape(m, -1)
        middles = np.einsum("kc,hcx->hkx", MID_NODE_WEIGHTS[: second_order - 8], points[bare.hexes]).reshape(-1, 3)
        points = np.concatenate([points, middles])
    apart = len(points)
    other = np.array([[9, 0, 0], [10, 0, 0], [10, 1, 0], [9, 1, 0], [9.5, 0.5, 1], [9.5, 0.5, 2]], float)
    points = np.concatenate([points, other])
    quads = bare.topology.boundary_faces
    return Mesh(
        points,
        bare.hexes,
        node_data={"id": np.arange(len(points), dtype=np.int64)[::-1] * 3 + 5},
        hex_data={"id": np.arange(m, dtype=np.int64) * 2 + 100},
        node_sets={"wall": np.array([0, 4, 7]), "Second wall": np.array([2, n - 1])},
        hex_sets={"left half": np.array([0, 2, 5]), "overlapping": np.array([2, 3])},
        side_sets={"inlet": np.array([[0, 0], [0, 4], [5, 1]]), "outlet": np.array([[m - 1, f] for f in range(6)])},
        cells=(
            Cells("quad", quads[:5], {"id": np.arange(5, dtype=np.int64) + 1}, {"lid": np.array([1, 3])}),
            Cells("line", bare.topology.edges[:3], {"id": np.arange(3, dtype=np.int64) + 50}, {"seam": np.arange(3)}),
            Cells("tetra", apart + np.array([[0, 1, 2, 4]]), {"id": np.array([60])}, {"overlapping": np.array([0])}),
            Cells("pyramid", apart + np.array([[0, 1, 2, 3, 5]]), {"id": np.array([61])}),
        ),
        mid_nodes=mids,
    )


def read_back(path: Path, mesh: Mesh, **options: object) -> Mesh:
    """What is read of a mesh that was written there."""
    io.write(path, mesh, **options)
    return io.read(path)


def read_content(path: Path, content: str | bytes) -> Mesh:
    """The mesh of a file with the given content."""
    path.write_bytes(content.encode() if isinstance(content, str) else content)
    return io.read(path)


def assert_refused(path: Path, words: str, content: str | None = None) -> None:
    """Fail unless a file, with its content if that is given, is refused with a sentence that holds the words."""
    if content is not None:
        path.write_text(content)
    with pytest.raises(FileError) as error:
        io.read(path)
    assert words in str(error.value)


def assert_same(a: Mesh, b: Mesh, *, without: tuple[str, ...] = ()) -> None:
    """Fail unless two meshes hold the same, but for some parts by their names."""
    np.testing.assert_array_equal(a.points, b.points)
    np.testing.assert_array_equal(a.hexes, b.hexes)
    assert (a.mid_nodes is None) == (b.mid_nodes is None)
    if a.mid_nodes is not None:
        np.testing.assert_array_equal(a.mid_nodes, b.mid_nodes)
    for part in ("node_sets", "hex_sets", "side_sets"):
        if part not in without:
            _assert_sets(getattr(a, part), getattr(b, part))
    if "ids" not in without:
        np.testing.assert_array_equal(a.node_data["id"], b.node_data["id"])
        np.testing.assert_array_equal(a.hex_data["id"], b.hex_data["id"])
    if "cells" not in without:
        assert [cells.kind for cells in a.cells] == [cells.kind for cells in b.cells]
        for one, other in zip(a.cells, b.cells, strict=True):
            np.testing.assert_array_equal(one.nodes, other.nodes)
            _assert_sets(one.sets, other.sets)
            if "ids" not in without:
                np.testing.assert_array_equal(one.data["id"], other.data["id"])


def _assert_sets(a: dict, b: dict) -> None:
    assert set(a) == set(b)
    for name, members in a.items():
        np.testing.assert_array_equal(members, b[name], err_msg=name)
