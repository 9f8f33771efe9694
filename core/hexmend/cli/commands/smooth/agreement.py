"""Errors of one rank that all ranks have to know."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, TypeVar

from hexmend.errors import HexmendError

if TYPE_CHECKING:
    from mpi4py import MPI

T = TypeVar("T")


class AgreedError(Exception):
    """Error that all ranks know.

    Parameters
    ----------
    problem : HexmendError
        That of this rank, or else of another.
    """

    def __init__(self, problem: HexmendError):
        super().__init__(str(problem))
        self.problem = problem


def agreed(comm: MPI.Comm, act: Callable[[], T], expected: type[HexmendError] = HexmendError) -> T:
    """Call a function on each rank, and return its result if it fails on none; all ranks call this together.

    Parameters
    ----------
    comm : mpi4py.MPI.Comm
    act : callable
        What it does together with other ranks is done when it raises.
    expected : type
        Errors on which ranks agree; others are raised at once.

    Raises
    ------
    AgreedError
        On all ranks, if it fails on any.
    """
    problem: HexmendError | None = None
    try:
        result = act()
    except expected as error:
        problem = error
    problems = comm.allgather(None if problem is None else str(problem))
    if any(problems):
        raise AgreedError(problem or HexmendError(next(filter(None, problems))))
    return result
