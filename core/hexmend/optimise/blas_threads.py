"""BLAS beside the kernels: one thread of it while SciPy's solvers work, so that the cores are the kernels'."""

from __future__ import annotations

from contextlib import AbstractContextManager
from functools import cache
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from threadpoolctl import ThreadpoolController


@cache
def _libraries() -> ThreadpoolController:
    import scipy.linalg  # noqa: F401  (brings a library of its own, which has to be there to be found)
    from threadpoolctl import ThreadpoolController

    return ThreadpoolController()


def one_blas_thread() -> AbstractContextManager[object]:
    """It shares out vectors of 10,000 numbers already, and its threads wait by spinning: on two busy cores a product of
    two vectors of 90,000 numbers, with them, takes longer than a gradient. Its sums depend on their number too.
    """
    return _libraries().limit(limits=1, user_api="blas")
