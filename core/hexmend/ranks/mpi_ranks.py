"""Ranks of an MPI program: sums over all of them, and rows of nodes that they send to their neighbours.

Variables of the launchers of MPI.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from importlib import import_module
from typing import TYPE_CHECKING

import numpy as np

from hexmend.arrays import dot
from hexmend.energy.ranks import Ranks, T

if TYPE_CHECKING:
    from mpi4py import MPI

#: Rows of an array by the number of the rank that gets, or sends, them.
Rows = Mapping[int, np.ndarray]


class MPIRanks(Ranks):
    """The ranks of a communicator, with the nodes whose positions they exchange.

    Parameters
    ----------
    comm : mpi4py.MPI.Comm
    sent, received : mapping of int to (k,) int
        Nodes of this rank that another has as ghosts, and ghosts of this rank that the other owns, by the number of the
        other rank: both name the same nodes in the same order.
    """

    def __init__(self, comm: MPI.Comm, sent: Rows, received: Rows):
        mpi = import_module("mpi4py.MPI")  # which begins MPI
        self.number, self.count = comm.rank, comm.size
        self._mpi, self.comm, self._sent, self._received = mpi, comm, sent, received

    def _reduce(self, own: T, operation: MPI.Op) -> T:
        number, result = np.array([own]), np.empty(1, dtype=np.array(own).dtype)
        self.comm.Allreduce(number, result, operation)
        return result[0].item()

    def sum(self, own: T) -> T:
        return self._reduce(own, self._mpi.SUM)

    def least(self, own: T) -> T:
        return -self.greatest(-own)

    def greatest(self, own: T) -> T:
        """Return the greatest of a number over all ranks; NaN if it is NaN on one, which MPI leaves open."""
        unknown = own != own
        pair, found = np.array([-np.inf if unknown else own, unknown], dtype=np.float64), np.empty(2)
        self.comm.Allreduce(pair, found, self._mpi.MAX)
        return type(own)(np.nan if found[1] else found[0])

    def any(self, own: bool | np.ndarray) -> bool:
        return self._reduce(int(np.any(own)), self._mpi.MAX) > 0

    def norm(self, own: np.ndarray) -> float:
        return float(np.sqrt(self.sum(dot(own, own))))

    def gather(self, own: np.ndarray) -> np.ndarray:
        """Return the rows (k, ...) of all ranks, one rank's after another's, on every rank."""
        counts = np.array(self.comm.allgather(len(own)))
        rows = np.empty((counts.sum(), *own.shape[1:]), own.dtype)
        bytes_per_row = int(np.prod(own.shape[1:], dtype=int)) * own.itemsize
        sending = np.ascontiguousarray(own).reshape(-1).view(np.uint8)
        self.comm.Allgatherv(sending, [rows.reshape(-1).view(np.uint8), counts * bytes_per_row])
        return rows

    def complete(self, rows: np.ndarray) -> np.ndarray:
        self._exchange(rows, self._sent, self._received)
        return rows

    def exchange_of(self, positions: np.ndarray) -> Callable[[np.ndarray], object]:
        sent, received = self._at(positions)
        return lambda rows: self._exchange(rows, sent, received)

    def part(self, positions: np.ndarray) -> MPIRanks:
        return MPIRanks(self.comm, *self._at(positions))

    def _at(self, positions: np.ndarray) -> tuple[Rows, Rows]:
        def placed(rows: Rows) -> Rows:
            found = {rank: positions[at] for rank, at in rows.items()}
            return {rank: at[at >= 0] for rank, at in found.items() if (at >= 0).any()}

        return placed(self._sent), placed(self._received)

    def _exchange(self, rows: np.ndarray, sent: Rows, received: Rows) -> None:
        arriving = {rank: np.empty((at.size, *rows.shape[1:]), rows.dtype) for rank, at in received.items()}
        requests = [self.comm.Irecv(buffer, source=rank) for rank, buffer in arriving.items()]
        leaving = {rank: rows[at] for rank, at in sent.items()}
        requests += [self.comm.Isend(buffer, dest=rank) for rank, buffer in leaving.items()]
        self._mpi.Request.Waitall(requests)
        for rank, buffer in arriving.items():
            rows[received[rank]] = buffer


#: Variables in which launchers tell each process the number of processes on its machine.
_LOCAL_SIZES = "OMPI_COMM_WORLD_LOCAL_SIZE", "MPI_LOCALNRANKS"


def local_ranks() -> int:
    """Return the number of ranks on this machine, as the launcher of this process says; 1 without one."""
    return next((int(os.environ[name]) for name in _LOCAL_SIZES if os.environ.get(name, "").isdecimal()), 1)
