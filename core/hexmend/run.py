"""The only loop: a smoother's steps become iterations with clocks, figures, stop conditions and an outcome."""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager
from dataclasses import dataclass
from functools import cache, lru_cache
from time import perf_counter
from typing import Any

import numpy as np
from threadpoolctl import ThreadpoolController

from hexmend.gallery import make
from hexmend.mesh import Mesh
from hexmend.optimise import Iteration, Outcome, Result
from hexmend.parameters import Parametrised, parameter
from hexmend.quality import measure, summarise
from hexmend.quality.measure import read_only
from hexmend.smoothers import METHODS, Smoother

log = logging.getLogger(__name__)

#: An objective still falls if a step lowers it by a greater share than the first, and by more than the second: a
#: hundredth of what one hex of q = 1/2 has.
_FALLING, _WORTH = 1e-3, 1e-2


@dataclass(frozen=True)
class Stop(Parametrised):
    """When a run ends by itself."""

    max_iterations: int = parameter(300, low=0, high=1_000_000, help="Most iterations of a run.")
    tolerance: float = parameter(
        1e-4,
        low=0,
        high=1,
        unit="mean edge length",
        help="Converged when no node moves further than this in an iteration (Algorithm A.1).",
    )
    max_seconds: float = parameter(
        0.0,
        low=0,
        high=1e7,
        unit="s",
        help="Most seconds in the smoother; 0 sets no limit. The iteration at hand ends.",
    )


class Run(Iterator[Iteration]):
    """A smoother at work on a mesh: an iterator of iterations that knows its record and, at the end, its outcome.

    Attributes
    ----------
    start : Iteration
        Number 0: the mesh as given, made ready by the method.
    last : Iteration
        The newest.
    reached : Iteration
        The one that is the run's result: the last, or, if the method ranks them, the best so far.
    history : list of dict
        `Iteration.row` of every iteration so far, number 0 first.
    outcome : Outcome or None
        None while the run goes on.
    decisions : list of str
        What the method decided on the way, in sentences.
    setup_seconds : float
        What the method's preparation took.
    """

    def __init__(self, mesh: Mesh, smoother: Smoother, stop: Stop):
        self.mesh = mesh
        self.smoother = smoother
        self.stop = stop
        self.outcome: Outcome | None = None
        warm_up(smoother)
        began = perf_counter()
        self._steps = smoother.steps(mesh)
        with _one_blas_thread():
            first = next(self._steps)
        self._unit = mesh.mean_edge_length or 1.0
        self.setup_seconds = perf_counter() - began
        self.start = self.last = self.reached = Iteration(
            0, read_only(first.points), measure(first.points, mesh.hexes), 0.0, 0.0
        )
        self._reached_rank = self._rank(self.start)
        self.history = [self.start.row()]
        self.decisions: list[str] = []
        if not mesh.free.any():
            self._end(Outcome.NOTHING_FREE)
        elif stop.max_iterations == 0:
            self._end(Outcome.MAX_ITERATIONS)

    def __next__(self) -> Iteration:
        if self.outcome is not None:
            raise StopIteration
        began = perf_counter()
        try:
            with _one_blas_thread():
                step = next(self._steps)
        except StopIteration as end:
            self._end(end.value or Outcome.FINISHED)
            raise StopIteration from None
        seconds = self.last.seconds + perf_counter() - began
        points = read_only(step.points)
        move = float(np.sqrt(np.square(points - self.last.points).sum(axis=1).max())) / self._unit
        figures = step.figures if step.figures is not None else measure(points, self.mesh.hexes)
        self.last = Iteration(self.last.number + 1, points, figures, seconds, move, step.notes)
        self.history.append(self.last.row())
        rank = self._rank(self.last)
        if rank <= self._reached_rank:
            self.reached, self._reached_rank = self.last, rank
        if step.decision:
            self.decisions.append(step.decision)
        if move < self.stop.tolerance and not step.more and not self._falling():  # Algorithm A.1
            self._end(Outcome.CONVERGED)
        elif self.last.number >= self.stop.max_iterations:
            self._end(Outcome.MAX_ITERATIONS)
        elif 0 < self.stop.max_seconds <= seconds:
            self._end(Outcome.MAX_SECONDS)
        return self.last

    def _rank(self, iteration: Iteration) -> tuple[float, ...]:
        return self.smoother.rank(self.start.figures, iteration.figures) or ()

    def _falling(self) -> bool:
        """Whether an optimiser's objective still falls: beside the barrier steps are short, however much they gain."""
        before, now = (row["objective"] for row in self.history[-2:])
        known = before is not None and now is not None
        return self.smoother.optimises and known and before - now > max(_FALLING * before, _WORTH)

    def close(self) -> None:
        """End the run where it is; what was reached stands."""
        if self.outcome is None:
            self._end(Outcome.STOPPED)

    def _end(self, outcome: Outcome) -> None:
        self.outcome = outcome
        self._steps.close()
        log.info("%s ended: %s", self.smoother.name, outcome.value)

    @property
    def message(self) -> str:
        """What has been reached and why the run ended, in sentences."""
        at, inverted = self.last, self.reached.figures.n_inverted
        said = self.outcome.value if self.outcome is not None else "Running."
        count = f"{at.number} iteration{'s' * (at.number != 1)}"
        left = f"{inverted:,} hex{'es' * (inverted != 1)} still inverted" if inverted else "no hex is inverted"
        move = f"the last one moved a node by {at.largest_move:.2g} mean edge lengths at most; " if at.number else ""
        words = [said, f"{count} in {at.seconds:.3g} s; {move}{left}.", *self.decisions]
        if self.reached is not self.last:
            words.append(f"Kept is iteration {self.reached.number}, better than what came after.")
        return " ".join(words)

    def result(self) -> Result:
        """The record of the run as far as it went."""
        mesh = self.mesh.with_points(self.reached.points)
        return Result(
            mesh=mesh,
            before=summarise(self.mesh, self.start.figures),
            after=summarise(mesh, self.reached.figures),
            method=self.smoother.name,
            parameters=self.smoother.values(),
            outcome=self.outcome or Outcome.STOPPED,
            message=self.message,
            iterations=self.last.number,
            seconds=self.last.seconds,
            setup_seconds=self.setup_seconds,
            history=tuple(self.history),
        )


def iterate(mesh: Mesh, smoother: Smoother | str, stop: Stop | None = None) -> Run:
    """Run a smoother step by step.

    Parameters
    ----------
    mesh : Mesh
        Stays as it is.
    smoother : Smoother or str
        A smoother, or the name of one to be used with its defaults.
    stop : Stop, optional

    Returns
    -------
    Run
        An iterator of `Iteration`; leaving it early loses nothing.

    Examples
    --------
    >>> import hexmend as hx
    >>> mesh = hx.gallery.make("cube", size=64, scramble=0.3)
    >>> for it in hx.iterate(mesh, hx.LocalSteepestDescent(), hx.Stop(max_iterations=3)):
    ...     print(it.number, it.figures.n_inverted == 0)
    1 True
    2 True
    3 True
    """
    chosen = METHODS[smoother]() if isinstance(smoother, str) else smoother
    return Run(mesh, chosen, stop or Stop())


def smooth(
    mesh: Mesh,
    smoother: Smoother | str,
    stop: Stop | None = None,
    *,
    watch: Callable[[Iteration], Any] | None = None,
) -> Result:
    """Run a smoother to its end.

    Parameters
    ----------
    mesh, smoother, stop
        As for `iterate`.
    watch : callable, optional
        Called with each iteration; the run ends as stopped where it returns False.

    Examples
    --------
    >>> import hexmend as hx
    >>> result = hx.smooth(hx.gallery.make("cube", size=64, scramble=0.3), "local-sd")
    >>> result.outcome.name, round(result.after.q_min, 3)
    ('CONVERGED', 1.0)
    """
    run = iterate(mesh, smoother, stop)
    for iteration in run:
        if watch is not None and watch(iteration) is False:
            run.close()
    return run.result()


@cache
def _threads() -> ThreadpoolController:
    return ThreadpoolController()


def _one_blas_thread() -> AbstractContextManager[object]:
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
