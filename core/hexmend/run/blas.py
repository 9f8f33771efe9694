"""BLAS beside the kernels: one thread of it, so that the cores are the kernels'."""

from __future__ import annotations

import sys
from contextlib import AbstractContextManager
from functools import cache
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from threadpoolctl import ThreadpoolController


@cache
def _libraries(with_scipy: bool) -> ThreadpoolController:
    """The libraries of BLAS that are loaded; SciPy brings one of its own, later than NumPy does or not at all."""
    from threadpoolctl import ThreadpoolController

    return ThreadpoolController()


def one_blas_thread() -> AbstractContextManager[object]:
    """While a method steps, BLAS keeps to one thread.

    It shares out vectors of 10,000 numbers already, and its threads wait by spinning: on two busy cores a product of
    two vectors of 90,000 numbers, with them, takes longer than a gradient. Its sums depend on the number of its threads
    too.
    """
    return _libraries("scipy.linalg" in sys.modules).limit(limits=1, user_api="blas")
