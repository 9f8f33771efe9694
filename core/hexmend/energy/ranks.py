"""Sums and values that the processes of a run share; this base class serves a run with one process."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

import numpy as np

from hexmend.arrays import euclidean_norm

T = TypeVar("T", int, float)


class Ranks:
    """The processes, or ranks, that share a run: this one alone. `hexmend.ranks.mpi_ranks` has those of MPI.

    All ranks call the methods together and get the same results.

    Attributes
    ----------
    number, count : int
        Number of this rank from 0, and of all ranks.
    """

    number, count = 0, 1

    def sum(self, own: T) -> T:
        """Return the sum of a number over all ranks."""
        return own

    def least(self, own: T) -> T:
        """Return the least of a number over all ranks."""
        return own

    def greatest(self, own: T) -> T:
        """Return the greatest of a number over all ranks."""
        return own

    def any(self, own: bool | np.ndarray) -> bool:
        """Return True if any mark of any rank is set; `own` is a mark or an array of them."""
        return bool(np.any(own))

    def norm(self, own: np.ndarray) -> float:
        """Return the Euclidean norm of an array that is divided among the ranks."""
        return euclidean_norm(own)

    def complete(self, rows: np.ndarray) -> np.ndarray:
        """Write the rows of nodes that other ranks own, of an array (n, ...) with a row for each node; returns it."""
        return rows

    def exchange_of(self, positions: np.ndarray) -> Callable[[np.ndarray], object]:
        """Return a function like `complete` of arrays in which node i has row positions[i], (n,) int; -1: none."""
        return self.complete

    def part(self, positions: np.ndarray) -> Ranks:
        """Return the ranks for a part of the mesh in which node i has the number positions[i], (n,) int; -1: none."""
        return self


ONE_RANK = Ranks()
