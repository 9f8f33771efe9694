"""Limit of BLAS to one thread while SciPy's solvers work, which leaves the cores to the kernels."""

from __future__ import annotations

from contextlib import AbstractContextManager
from functools import cache
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from threadpoolctl import ThreadpoolController


@cache
def _libraries() -> ThreadpoolController:
    import scipy.linalg  # noqa: F401  (loads a BLAS of its own, which threadpoolctl finds only then)
    from threadpoolctl import ThreadpoolController

    return ThreadpoolController()


def one_blas_thread() -> AbstractContextManager[object]:
    """Context in which BLAS uses one thread.

    BLAS splits vectors of 10,000 numbers already, and its threads wait by spinning: on two busy cores its product of
    two vectors of 90,000 numbers takes longer than a gradient. Its sums also depend on the number of threads.
    """
    return _libraries().limit(limits=1, user_api="blas")
