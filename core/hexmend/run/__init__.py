"""Runs: the only loop, and the two doors to it, `iterate` and `smooth`."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from hexmend.mesh import Mesh
from hexmend.optimise import Iteration, Result, Stop
from hexmend.recipe import Recipe
from hexmend.run.loop import Run
from hexmend.smoothers import METHODS, Smoother

__all__ = ["Run", "Stop", "iterate", "smooth"]


def iterate(mesh: Mesh, smoother: Smoother | Recipe | str, stop: Stop | None = None) -> Run:
    """Run a smoother or a recipe step by step.

    Parameters
    ----------
    mesh : Mesh
        Stays as it is.
    smoother : Smoother, Recipe or str
        A smoother, or the name of one to be used with its defaults; or a recipe.
    stop : Stop, optional
        For a recipe: in place of the limits of every stage.

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
    return Run(mesh, METHODS[smoother]() if isinstance(smoother, str) else smoother, stop)


def smooth(
    mesh: Mesh,
    smoother: Smoother | Recipe | str,
    stop: Stop | None = None,
    *,
    watch: Callable[[Iteration], Any] | None = None,
) -> Result:
    """Run a smoother or a recipe to its end.

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
