"""Mesh in parts: each rank holds one, and writes it as a piece.

Rows of arrays that ranks send to each other, and rows of nodes that each rank keeps for all.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from importlib import import_module
from typing import TYPE_CHECKING

import numpy as np

from hexmend.arrays import as_immutable_owned
from hexmend.io.formats.vtk.grid import HEXAHEDRON, Grid
from hexmend.io.formats.vtk.pvtu_writer import PieceFiles, numbered
from hexmend.mesh.mesh import Mesh
from hexmend.ranks.rank_part import RankPart

if TYPE_CHECKING:
    from mpi4py import MPI


def send_rows(comm: MPI.Comm, to: np.ndarray, *arrays: np.ndarray) -> tuple[np.ndarray, list[np.ndarray]]:
    """Send rows of arrays to other ranks; all ranks call it together.

    Parameters
    ----------
    comm : mpi4py.MPI.Comm
    to : (k,) int
        The rank that each row is sent to.
    arrays : (k, ...) array
        Of the same types and widths on all ranks.

    Returns
    -------
    counts : (P,) int64
        Number of rows that have come from each rank.
    arrays : list of array
        The rows that have come, those of one rank after those of another, in its order.
    """
    order = np.argsort(to, kind="stable")
    sent, counts = np.bincount(to, minlength=comm.size).astype(np.int64), np.empty(comm.size, np.int64)
    comm.Alltoall(sent, counts)
    return counts, [_exchanged(comm, np.asarray(array)[order], sent, counts) for array in arrays]


def _exchanged(comm: MPI.Comm, rows: np.ndarray, sent: np.ndarray, received: np.ndarray) -> np.ndarray:
    """Send consecutive rows of an array, `sent[r]` of them to rank r, and get `received[r]` from it."""
    mpi, shape = import_module("mpi4py.MPI"), rows.shape[1:]
    width = int(np.prod(shape, dtype=int)) * rows.dtype.itemsize
    arriving = np.empty((int(received.sum()), *shape), rows.dtype)
    row = mpi.BYTE.Create_contiguous(width).Commit()
    try:
        leaving = np.ascontiguousarray(rows)
        comm.Alltoallv(
            [_memory(leaving), sent, _begins(sent), row], [_memory(arriving), received, _begins(received), row]
        )
    finally:
        row.Free()
    return arriving


def _memory(array: np.ndarray) -> np.ndarray:
    return array.reshape(-1).view(np.uint8)


def _begins(counts: np.ndarray) -> np.ndarray:
    return np.concatenate([[0], np.cumsum(counts)[:-1]])


class Directory:
    """Rows of the nodes of the whole mesh: each rank keeps a range of node numbers.

    All ranks call the methods together.

    Parameters
    ----------
    comm : mpi4py.MPI.Comm
    n : int
        Number of all nodes.

    Attributes
    ----------
    begin, end : int
        The nodes that this rank keeps rows of.
    """

    def __init__(self, comm: MPI.Comm, n: int):
        self.comm, self.n = comm, n
        self._bounds = np.array([n * rank // comm.size for rank in range(comm.size + 1)], dtype=np.int64)
        self.begin, self.end = (int(bound) for bound in self._bounds[comm.rank : comm.rank + 2])

    def put(self, ids: np.ndarray, *rows: np.ndarray) -> tuple[np.ndarray, list[np.ndarray]]:
        """Send rows of nodes to the ranks that keep them.

        Returns
        -------
        at : (j,) int64
            Which of its nodes, counted from `begin`, each row is of that this rank has got. A node may have several.
        rows : list of (j, ...) array
        """
        _, (numbers, *arrived) = send_rows(self.comm, self._home(ids), ids, *rows)
        return numbers - self.begin, arrived

    def get(self, ids: np.ndarray, *kept: np.ndarray) -> list[np.ndarray]:
        """Return rows of nodes (k,) int64 from arrays with a row for each node that a rank keeps."""
        home = self._home(ids)
        counts, (asked,) = send_rows(self.comm, home, ids)
        back = np.repeat(np.arange(self.comm.size), counts)
        _, answers = send_rows(self.comm, back, *(np.asarray(rows)[asked - self.begin] for rows in kept))
        place = np.empty(len(ids), np.int64)
        place[np.argsort(home, kind="stable")] = np.arange(len(ids))
        return [answer[place] for answer in answers]

    def _home(self, ids: np.ndarray) -> np.ndarray:
        return np.searchsorted(self._bounds, ids, side="right") - 1


@dataclass(frozen=True, eq=False)
class PieceCells:
    """Cells that one rank writes, its hexes first; each cell of the mesh is written by one rank.

    Parameters
    ----------
    ids : (c,) int64
        Their numbers in the whole mesh.
    types : (k,) uint8
        VTK types of the last k cells, which are no hexes.
    start : (k + 1,) int64
        Other cell i has the nodes nodes[start[i]:start[i + 1]].
    nodes : (start[-1],) int
        Numbers in the whole mesh.
    data : mapping of str to (c, ...) array
    """

    ids: np.ndarray
    types: np.ndarray
    start: np.ndarray
    nodes: np.ndarray
    data: Mapping[str, np.ndarray]


@dataclass(frozen=True, eq=False)
class DividedMesh:
    """Mesh in parts, one on each rank; all ranks call the methods together.

    Parameters
    ----------
    part : RankPart
    hex_ids : (m,) int64
        Numbers of the hexes of the part in the whole mesh, ascending.
    directory : Directory
    points : (k, 3) float64
        Of the nodes that this rank keeps in the directory.
    node_data : mapping of str to (k, ...) array
        Of these nodes.
    unused : (k,) bool
        Those of these nodes that no hex has.
    cells : PieceCells
    field_data : mapping of str to object
    """

    part: RankPart
    hex_ids: np.ndarray
    directory: Directory
    points: np.ndarray
    node_data: Mapping[str, np.ndarray]
    unused: np.ndarray
    cells: PieceCells
    field_data: Mapping[str, object]

    def write(self, files: PieceFiles, points: np.ndarray) -> None:
        """Write a piece with points (n, 3) of the nodes of the part; then rank 0 writes the file that names them all.

        Raises
        ------
        FileError
            On each rank whose piece cannot be written. `finish` is to be called once all are known to be written.
        """
        self._put(points)
        files.write_piece(self.directory.comm.rank, self._grid())

    def finish(self, files: PieceFiles) -> None:
        """Write the file that names the pieces; for rank 0 alone, after `write`."""
        node_data = {name: rows[:1] for name, rows in self.node_data.items()}
        empty = np.empty(0, np.int64)
        grid = Grid(self.points, empty, empty, empty, node_data, self.cells.data)
        files.finish(self.directory.comm.size, numbered(grid, np.zeros(1, np.int64), np.zeros(1, np.int64)))

    def gather(self, points: np.ndarray) -> Mesh | None:
        """Return the whole mesh with points (n, 3) on rank 0, for what ranks cannot do; None on the others."""
        comm, part = self.directory.comm, self.part
        self._put(points)
        hexes = part.mesh.hexes[part.counted]
        ids, rows = comm.gather(self.hex_ids[part.counted]), comm.gather(part.nodes[hexes])
        places, fixed = comm.gather(self.points), comm.gather((part.nodes[part.owned], part.mesh.fixed[part.owned]))
        if comm.rank:
            return None
        stays = np.ones(self.directory.n, dtype=bool)
        for nodes, marks in fixed:
            stays[nodes] = marks
        hexes = np.concatenate(rows)[np.argsort(np.concatenate(ids))].astype(np.int32)
        return Mesh(as_immutable_owned(np.concatenate(places)), as_immutable_owned(hexes)).with_fixed(stays)

    def scatter(self, mesh: Mesh | None) -> np.ndarray:
        """Return the points of the part, (n, 3), from the whole mesh on rank 0."""
        everything = np.arange(self.directory.n) if mesh is not None else np.empty(0, np.int64)
        at, (rows,) = self.directory.put(everything, np.empty((0, 3)) if mesh is None else mesh.points)
        self.points[at] = rows
        return self.directory.get(np.asarray(self.part.nodes, np.int64), self.points)[0]

    def _put(self, points: np.ndarray) -> None:
        """Take over the points of the nodes of the part, from the ranks that own them."""
        part = self.part
        at, (rows,) = self.directory.put(part.nodes[part.owned].astype(np.int64), points[part.owned])
        self.points[at] = rows

    def _grid(self) -> Grid:
        """The piece of this rank: its cells with their nodes, the nodes that it owns, and those of no hex."""
        cells, part = self.cells, self.part
        hexes = part.nodes[part.mesh.hexes[part.counted]]
        left = self.directory.begin + np.flatnonzero(self.unused)
        nodes = np.unique(np.concatenate([part.nodes[part.owned], left, hexes.ravel(), cells.nodes]))
        points, *data = self.directory.get(nodes, self.points, *self.node_data.values())
        numbers = np.searchsorted(nodes, np.concatenate([hexes.ravel(), cells.nodes])).astype(np.int32)
        start = np.concatenate([8 * np.arange(len(hexes)), 8 * len(hexes) + cells.start])
        types = np.concatenate([np.full(len(hexes), HEXAHEDRON, np.uint8), cells.types])
        field_data = self.field_data if self.directory.comm.rank == 0 else {}
        named = dict(zip(self.node_data, data, strict=True))
        return numbered(Grid(points, types, start, numbers, named, cells.data, field_data), nodes, cells.ids)
