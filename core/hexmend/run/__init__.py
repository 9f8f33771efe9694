"""Runs of smoothers and recipes: `iterate` gives one iteration after the other, `smooth` the result."""

from __future__ import annotations

import dataclasses
import os
from collections.abc import Callable, Sequence
from typing import Any

from hexmend.errors import ParameterError
from hexmend.iteration import Iteration, Result, StoppingCriteria
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.rules import MotionRules
from hexmend.mesh.rules.resolution import with_rules
from hexmend.parameters import declared, suggestion
from hexmend.run.progress import progress_display
from hexmend.run.recipe import Recipe
from hexmend.run.run import Run
from hexmend.smoothers import DEFAULT_METHOD, METHODS, Smoother

#: Names of rules of motion, which runs take as settings.
_RULES = tuple(one.name for one in dataclasses.fields(MotionRules))

__all__ = ["Run", "StoppingCriteria", "iterate", "smooth"]


def iterate(
    mesh: Mesh | str | os.PathLike[str],
    method: Smoother | Recipe | str = DEFAULT_METHOD,
    stop: StoppingCriteria | None = None,
    **settings: Any,
) -> Run:
    """Run a method or a recipe step by step.

    Parameters
    ----------
    mesh : Mesh or path
        A mesh, which is not changed, or the path of a file.
    method : Smoother, Recipe or str
        A method, the name of one to be used with its defaults, or a recipe.
    stop : StoppingCriteria, optional
        Limits; for a recipe they replace those of every stage.
    **settings
        Parameters of the method and limits by name, such as `boundary="slide", max_iterations=50`. They replace those
        of `method` and `stop`. A recipe takes only limits, which hold for every stage. Rules of motion by name, such
        as `interfaces="slide", fix=["inlet"]`, hold in addition to those of the mesh: see
        `hexmend.mesh.rules.MotionRules`.

    Returns
    -------
    Run
        An iterator of `Iteration`; it has the result at any time.

    Raises
    ------
    ParameterError
        For a method that does not exist, a name that neither the method nor `StoppingCriteria` nor `MotionRules` has,
        and a value out of bounds; the message suggests the nearest name and lists all.
    FileError, MeshError
        If the file cannot be read, or hexes are numbered left-handed.

    Examples
    --------
    >>> import hexmend as hx
    >>> mesh = hx.gallery.make("cube", size=64, scramble=0.3)
    >>> for it in hx.iterate(mesh, "local-sd", max_iterations=3):
    ...     print(it.number, it.inverted)
    1 0
    2 0
    3 0
    """
    given = {name: settings.pop(name) for name in _RULES if name in settings}
    smoother, stop = _configured(method, stop, settings)
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
    method: Smoother | Recipe | str = DEFAULT_METHOD,
    stop: StoppingCriteria | None = None,
    *,
    progress: bool | None = None,
    watch: Callable[[Iteration], Any] | None = None,
    **settings: Any,
) -> Result:
    """Run a method or a recipe to its end.

    Parameters
    ----------
    mesh : Mesh or path
        A mesh, which is not changed, or the path of a file.
    method : Smoother, Recipe or str
        A method, the name of one to be used with its defaults (see `hexmend.METHODS`), or a recipe.
    stop : StoppingCriteria, optional
        Limits; for a recipe they replace those of every stage.
    progress : bool, optional
        By default a run of more than half a second shows a bar on a terminal (on standard error) and in a notebook.
        True shows its progress elsewhere too, a line every few seconds; False shows nothing.
    watch : callable, optional
        Called with each iteration; the run is stopped if it returns False.
    **settings
        Parameters of the method (`boundary`, `goal`, `target`, ...), limits (`max_iterations`, `max_seconds`,
        `tolerance`, ...) and rules of motion (`fix`, `slide`, `free`, `plane`, `periodic`, `interfaces`) by name; see
        `iterate`.

    Returns
    -------
    Result
        With the mesh, `result.mesh`, and its summaries before and after.

    Raises
    ------
    ParameterError
        For a method or a name that does not exist, and a value out of bounds; the message suggests the nearest name.
    FileError, MeshError
        If the file cannot be read, or hexes are numbered left-handed.

    Examples
    --------
    >>> import hexmend as hx
    >>> result = hx.smooth(hx.gallery.make("cube", size=64, scramble=0.3))
    >>> result.outcome.name, round(result.after.q_min, 3)
    ('CONVERGED', 1.0)
    """
    display = progress_display(progress)
    run = iterate(mesh, method, stop, **settings)
    try:
        for iteration in run:
            display.show(run)
            if watch is not None and watch(iteration) is False:
                run.close()
    finally:
        display.close()
    run.move_mid_nodes()
    return run.result()


def _read(mesh: Mesh | str | os.PathLike[str]) -> Mesh:
    if isinstance(mesh, Mesh):
        return mesh
    if not isinstance(mesh, str | os.PathLike):
        own = "; that of a result is result.mesh" if isinstance(mesh, Result) else ""
        raise TypeError(f"{type(mesh).__name__} is not a mesh: expected a hexmend.Mesh or the path of a file{own}")
    from hexmend.io import read  # the formats are not loaded for a mesh in memory

    return read(mesh)


def _configured(
    method: Smoother | Recipe | str, stop: StoppingCriteria | None, settings: dict[str, Any]
) -> tuple[Smoother | Recipe, StoppingCriteria | None]:
    """Return the smoother or recipe and its limits, with the settings applied."""
    smoother = _named(method) if isinstance(method, str) else method
    if not isinstance(smoother, Smoother | Recipe):
        raise TypeError(f"{type(smoother).__name__} is not a method: expected a hexmend.Smoother, a Recipe or a name")
    names = sorted(one.name for one in declared(StoppingCriteria))
    own = [] if isinstance(smoother, Recipe) else [one.name for one in declared(smoother)]
    values = dict(settings)
    for name in values:
        if name not in names and name not in own:
            raise _unknown(smoother, name, [*own, *names, *_RULES])
    limits_given = {name: values.pop(name) for name in names if name in values}
    if values:
        smoother = dataclasses.replace(smoother, **values)
    if limits_given and isinstance(smoother, Recipe) and stop is None:
        return smoother.limited(**limits_given), None
    return smoother, dataclasses.replace(stop or StoppingCriteria(), **limits_given) if limits_given else stop


def _named(name: str) -> Smoother | Recipe:
    """Return a method with its defaults, or a recipe of Hexmend, by name."""
    if name not in METHODS:
        from hexmend.run.recipe_files import read_recipe, supplied_recipes  # not needed for methods

        if name in supplied_recipes():
            return read_recipe(name)
    return METHODS[name]()


def _unknown(smoother: Smoother | Recipe, name: str, known: Sequence[str]) -> ParameterError:
    """Make the error for a setting that a method does not have."""
    others = [one.name for one in METHODS.values() if name in {parameter.name for parameter in declared(one)}]
    if others and isinstance(smoother, Recipe):
        advice = "set it for the methods of its stages; "
    else:
        advice = f"it is a parameter of {', '.join(others)}; " if others else suggestion(name, known)
    return ParameterError(f"{smoother.name} has no parameter {name!r}: {advice}known: {', '.join(known)}")
