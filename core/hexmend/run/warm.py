"""What is done so that clocks count the method's own work alone."""

from __future__ import annotations

from contextlib import AbstractContextManager
from functools import cache, lru_cache

from threadpoolctl import ThreadpoolController

from hexmend.gallery import make
from hexmend.quality import measure
from hexmend.smoothers import METHODS, Smoother


@cache
def _threads() -> ThreadpoolController:
    return ThreadpoolController()


def one_blas_thread() -> AbstractContextManager[object]:
    """While a method steps, the cores are the kernels'.

    BLAS shares out vectors of 10,000 numbers already. Its threads and the kernels' wait by spinning: side by side they
    make a Newton step six times slower.
    """
    return _threads().limit(limits=1, user_api="blas")


@lru_cache(maxsize=64)
def warm_up(smoother: Smoother) -> None:
    """Load or compile what a smoother calls, on a mesh of 27 hexes, so that no clock counts it."""
    mesh = make("cube", size=27, scramble=0.2)
    measure(mesh.points, mesh.hexes)
    steps = smoother.steps(mesh)
    for _ in range(2):
        next(steps, None)
    steps.close()
    for name in smoother.uses:
        warm_up(METHODS[name]())
