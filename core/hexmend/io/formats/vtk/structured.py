"""VTK's XML formats for structured grids: .vts, .vtr (rectilinear) and .vti (image data), read as hexes."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from hexmend.io.base.format import register
from hexmend.io.formats.vtk.grid import HEXAHEDRON, Grid, to_mesh
from hexmend.io.formats.vtk.merge_grids import merge_grids
from hexmend.io.formats.vtk.vtu import read_data
from hexmend.io.formats.vtk.xml_arrays import read_values
from hexmend.io.formats.vtk.xml_document import Document, XMLElement
from hexmend.mesh.hexahedron import VOXEL_ORDER
from hexmend.mesh.mesh import Mesh

KINDS = ("StructuredGrid", "RectilinearGrid", "ImageData")
_ROOT = re.compile(rb"<VTKFile\s[^>]*type\s*=\s*[\"'](?:%s)[\"']" % "|".join(KINDS).encode())


def structured_cells(counts: list[int]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Types, starts and nodes of the hexes of a structured grid, as of `Grid`; `counts` are its nodes along x, y, z."""
    nx, ny, nz = counts
    number = np.arange(nx * ny * nz).reshape(nz, ny, nx)
    ends = slice(None, -1), slice(1, None)
    corners = [number[z, y, x].ravel() for z in ends for y in ends for x in ends]
    nodes = np.column_stack(corners)[:, VOXEL_ORDER]
    return np.full(len(nodes), HEXAHEDRON, np.uint8), 8 * np.arange(len(nodes) + 1), nodes.ravel()


def grid_points(axes: list[np.ndarray]) -> np.ndarray:
    """Points of a rectilinear grid, (n, 3) float64, of its coordinates along x, y and z; x runs fastest."""
    z, y, x = np.meshgrid(*axes[::-1], indexing="ij")
    return np.column_stack([x.ravel(), y.ravel(), z.ravel()]).astype(np.float64)


def read(path: Path) -> Mesh:
    """Read a structured grid and merge its pieces."""
    return to_mesh(path, merge_grids(read_grids(path), in_files=True))


def read_grids(path: Path) -> list[Grid]:
    """Read the pieces of a file; raises `FileError` where it is damaged or holds none."""
    with Document(path, *KINDS) as document:
        top = document.root.first(document.root.get("type"))
        grids = [_read_grid(document, top, piece) for piece in top.all("Piece")]
        if not grids:
            raise document.error("holds no Piece")
    return grids


def _read_grid(document: Document, top: XMLElement, piece: XMLElement) -> Grid:
    extent = _numbers(document, piece, "Extent", 6).astype(np.int64)
    counts = [int(high - low) + 1 for low, high in extent.reshape(3, 2)]
    if min(counts) < 2 or np.prod(counts, dtype=np.float64) > 2**40:
        raise document.error(f"has the extent {extent.tolist()}: expected two nodes or more along x, y and z")
    n_nodes, n_cells = int(np.prod(counts)), int(np.prod(np.array(counts) - 1))
    if top.name == "ImageData":
        origin, spacing = (_numbers(document, top, key, 3, word) for key, word in (("Origin", 0), ("Spacing", 1)))
        turn = _numbers(document, top, "Direction", 9) if top.get("Direction") else np.eye(3)
        document.budget.charge(24 * n_nodes, "its points")
        steps = grid_points([np.arange(low, high + 1) for low, high in extent.reshape(3, 2)]) * spacing
        points = origin + steps @ turn.reshape(3, 3).T
    elif top.name == "RectilinearGrid":
        arrays = piece.first("Coordinates").arrays()
        if len(arrays) != 3:
            raise document.error(f"its Coordinates hold {len(arrays)} arrays: expected 3")
        document.budget.charge(24 * n_nodes, "its points")
        points = grid_points([read_values(document, one, n) for one, n in zip(arrays, counts, strict=True)])
    else:
        arrays = piece.first("Points").arrays()
        if not arrays:
            raise document.error("its Points hold no array")
        points = read_values(document, arrays[0], 3 * n_nodes).reshape(-1, 3).astype(np.float64, copy=False)
    of_nodes = read_data(document, piece.first("PointData"), n_nodes, {})
    of_cells = read_data(document, piece.first("CellData"), n_cells, {})
    document.budget.charge(64 * n_cells, "its cells")
    return Grid(points, *structured_cells(counts), of_nodes, of_cells)


def _numbers(document: Document, element: XMLElement, key: str, count: int, default: float | None = None) -> np.ndarray:
    """Numbers of an attribute, (count,) float64."""
    words = element.get(key, " ".join([str(default)] * count) if default is not None else "").split()
    try:
        values = np.array([float(word) for word in words])
    except ValueError:
        values = np.zeros(0)
    if len(values) != count or not np.isfinite(values).all():
        raise document.error(f"{key} of {element.name} is {' '.join(words)[:40]!r}: expected {count} numbers")
    return values


register(
    name="vts",
    title="VTK structured grid",
    suffixes=(".vts", ".vtr", ".vti"),
    encodings=(),
    read=read,
    matches=lambda head: _ROOT.search(head) is not None,
)
