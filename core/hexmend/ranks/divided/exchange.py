"""Rows of arrays that ranks send to each other, and rows of nodes that each rank keeps for all."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

import numpy as np

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
