"""Runs of smoothers and recipes: `iterate` gives one iteration after the other, `smooth` the result."""

from __future__ import annotations

import dataclasses
import os
from collections.abc import Callable
from typing import Any

from hexmend.aliases import exports
from hexmend.errors import ParameterError
from hexmend.iteration import Iteration, Result, StoppingCriteria
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.rules import MotionRules
from hexmend.mesh.rules.resolution import with_rules
from hexmend.parameters import current_name, declared, hint
from hexmend.run.recipe import Recipe
from hexmend.run.run import Run
from hexmend.smoothers import DEFAULT_METHOD, METHODS, Smoother

#: Names of rules of motion, which runs take as settings.
_RULES = tuple(one.name for one in dataclasses.fields(MotionRules))

__all__ = ["Run", "StoppingCriteria", "iterate", "smooth"]


def iterate(
    mesh: Mesh | str | os.PathLike[str],
    smoother: Smoother | Recipe | str = DEFAULT_METHOD,
    stop: StoppingCriteria | None = None,
    **settings: Any,
) -> Run:
    """Run a smoother or a recipe step by step.

    Parameters
    ----------
    mesh : Mesh or path
        A mesh, which is not changed, or the path of a file.
    smoother : Smoother, Recipe or str
        A smoother, the name of one to be used with its defaults, or a recipe.
    stop : StoppingCriteria, optional
        Limits; for a recipe they replace those of every stage.
    **settings
        Parameters of the method and limits by name, such as `boundary="slide", max_iterations=50`. They replace those
        of `smoother` and `stop`. A recipe takes only limits, which hold for every stage. Rules of motion by name, such
        as `interfaces="slide", fix=["inlet"]`, hold in addition to those of the mesh: see
        `hexmend.mesh.rules.MotionRules`.

    Returns
    -------
    Run
        An iterator of `Iteration`; it has the result at any time.

    Raises
    ------
    ParameterError
        For a name that neither the method nor `StoppingCriteria` has, and for a value out of bounds.
    FileError, MeshError
        If the file cannot be read.

    Examples
    --------
    >>> import hexmend as hx
    >>> mesh = hx.gallery.make("cube", size=64, scramble=0.3)
    >>> for it in hx.iterate(mesh, hx.LocalSteepestDescent(), max_iterations=3):
    ...     print(it.number, it.quality.n_inverted == 0)
    1 True
    2 True
    3 True
    """
    given = {name: settings.pop(name) for name in _RULES if name in settings}
    smoother, stop = _configured(smoother, stop, settings)
    mesh = _read(mesh)
    if given:
        rules = mesh.node_rules.rules
        if isinstance(smoother, Recipe):  # its rules are merged here, so that those that are given replace them
            rules, smoother = rules.merge(smoother.rules), dataclasses.replace(smoother, rules=MotionRules())
        rules = rules.merge(MotionRules(**given))
        mesh = with_rules(mesh, dataclasses.replace(rules, interfaces=given.get("interfaces", rules.interfaces)))
    return Run(mesh, smoother, stop)


def smooth(
    mesh: Mesh | str | os.PathLike[str],
    smoother: Smoother | Recipe | str = DEFAULT_METHOD,
    stop: StoppingCriteria | None = None,
    *,
    watch: Callable[[Iteration], Any] | None = None,
    **settings: Any,
) -> Result:
    """Run a smoother or a recipe to its end.

    Parameters
    ----------
    mesh, smoother, stop, **settings
        See `iterate`.
    watch : callable, optional
        Called with each iteration; the run is stopped if it returns False.

    Returns
    -------
    Result

    Raises
    ------
    ParameterError, FileError, MeshError
        See `iterate`.

    Examples
    --------
    >>> import hexmend as hx
    >>> result = hx.smooth(hx.gallery.make("cube", size=64, scramble=0.3))
    >>> result.outcome.name, round(result.after.q_min, 3)
    ('CONVERGED', 1.0)
    """
    run = iterate(mesh, smoother, stop, **settings)
    for iteration in run:
        if watch is not None and watch(iteration) is False:
            run.close()
    return run.result()


def _read(mesh: Mesh | str | os.PathLike[str]) -> Mesh:
    if isinstance(mesh, Mesh):
        return mesh
    if not isinstance(mesh, str | os.PathLike):
        raise TypeError(f"{type(mesh).__name__} is not a mesh: expected a hexmend.Mesh or the path of a file")
    from hexmend.io import read  # the formats are not loaded for a mesh in memory

    return read(mesh)


def _configured(
    smoother: Smoother | Recipe | str, stop: StoppingCriteria | None, settings: dict[str, Any]
) -> tuple[Smoother | Recipe, StoppingCriteria | None]:
    """Return the smoother or recipe and its limits, with the settings applied."""
    if isinstance(smoother, str):
        smoother = METHODS[smoother]()
    if not isinstance(smoother, Smoother | Recipe):
        raise TypeError(f"{type(smoother).__name__} is not a method: expected a hexmend.Smoother, a Recipe or a name")
    names = sorted(one.name for one in declared(StoppingCriteria))
    own = [] if isinstance(smoother, Recipe) else [one.name for one in declared(smoother)]
    values = {current_name(type(smoother), name): value for name, value in settings.items()}
    for name in values:
        if name not in names and name not in own:
            raise ParameterError(f"{smoother.name} has no parameter {name!r}: {hint(name, [*own, *names])}")
    limits_given = {name: values.pop(name) for name in names if name in values}
    if values:
        smoother = dataclasses.replace(smoother, **values)
    if limits_given and isinstance(smoother, Recipe) and stop is None:
        return smoother.limited(**limits_given), None
    return smoother, dataclasses.replace(stop or StoppingCriteria(), **limits_given) if limits_given else stop


__getattr__ = exports(__name__)
