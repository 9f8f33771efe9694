"""The recipe of a study as TOML: methods, lists of values that are multiplied out, and limits; docs/study-many.md.

Only data is read: nothing in a file is ever run.
"""

from __future__ import annotations

import itertools
import os
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from hexmend.errors import ParameterError
from hexmend.io.storage.toml_files import read_toml
from hexmend.parameters import declared, from_values
from hexmend.run import StoppingCriteria
from hexmend.run.recipe import check_keys, in_this_format, table_in
from hexmend.run.recipe_files import read_recipe
from hexmend.smoothers import METHODS
from hexmend.study.batch.case import Case, TaskLimits
from hexmend.toml_text import parse_toml

#: Cases of one study.
MOST = 10_000

#: What stands for the mesh's name in that of its surface.
NAME = "{mesh}"


@dataclass(frozen=True)
class Plan:
    """What a study does to each of its meshes.

    Parameters
    ----------
    title : str
    cases : tuple of Case
        Each with a name of its own.
    limits : TaskLimits
        Of each task.
    surface : Path or None
        What the boundary slides on where it does, if not itself; `{mesh}` in it is the mesh's name without suffix.
    """

    title: str
    cases: tuple[Case, ...]
    limits: TaskLimits = field(default_factory=TaskLimits)
    surface: Path | None = None

    def surface_of(self, mesh: Path) -> Path | None:
        """The file of the surface for a mesh."""
        return None if self.surface is None else Path(str(self.surface).replace(NAME, mesh.stem))


def read_plan(path: str | os.PathLike[str]) -> Plan:
    """Read the recipe of a study. Recipes and surfaces that it names are beside it.

    Raises
    ------
    FileError
        Where it, or a recipe that it names, cannot be read or is none: it names the line, or the table and the key.
    """
    path = Path(path)
    return read_toml(path, "a recipe", lambda text: plan_of(text, path.parent, path.stem))


def plan_of(text: str, folder: Path, title: str = "Study") -> Plan:
    """The plan that TOML text describes.

    Parameters
    ----------
    text : str
    folder : Path
        Where the files are that it names.
    title : str
        Where it has none.

    Raises
    ------
    ParameterError
        Naming the line where it is no TOML, else the table, the key and what was expected there.

    Examples
    --------
    >>> plan = plan_of('''
    ... format = 2
    ... methods = ["laplacian"]
    ... [[method]]
    ... method = "local-sd"
    ... parameters = { p = [2, 4], delta = 0.1 }
    ... stop = { max_iterations = [50, 100] }
    ... ''', Path("."))
    >>> [case.name for case in plan.cases][:3]
    ['laplacian', 'local-sd p=2 max_iterations=50', 'local-sd p=2 max_iterations=100']
    """
    data = in_this_format(parse_toml(text, "a recipe"))
    check_keys("the study", data, ("format", "title", "methods", "method", "stop", "task", "boundary"))
    if not isinstance(title := data.get("title", title), str):
        raise ParameterError(f"title = {title!r} is no text: expected a title in quotes")
    stop, boundary = table_in(data, "stop"), _boundary(table_in(data, "boundary"))
    surface = boundary.pop("surface", None)
    made = (case for place, table in _tables(data) for case in _placed(place, _cases(table, folder, stop, boundary)))
    cases = tuple(itertools.islice(made, MOST + 1))
    if not cases:
        raise ParameterError('the study has no method: expected a line such as  methods = ["mend", "getme"]')
    if len(cases) > MOST:
        raise ParameterError(f"lists multiplied out make more than {MOST:,} cases: shorten them")
    for name, count in Counter(case.name for case in cases).items():
        if count > 1:
            raise ParameterError(f"two of the methods would be called {name!r} in tables: give them a  title  each")
    if surface is not None and not any(case.slides for case in cases):
        raise ParameterError("surface names what the boundary slides on, and it is fixed: say boundary = slide")
    limits = from_values(TaskLimits, table_in(data, "task"), owner="task")
    return Plan(title, cases, limits, None if surface is None else folder / surface)


def _boundary(table: Mapping[str, Any]) -> dict[str, Any]:
    check_keys("[boundary]", table, ("boundary", "surface", "surface_tolerance"))
    if not isinstance(surface := table.get("surface", ""), str):
        raise ParameterError(f"surface = {surface!r} is no text: expected the name of a file in quotes")
    return ({"boundary": "slide"} if surface else {}) | dict(table)


def _tables(data: Mapping[str, Any]) -> Iterator[tuple[str, Mapping[str, Any]]]:
    """Each method's table, with where it stands."""
    names, tables = data.get("methods", []), data.get("method", [])
    if not isinstance(names, list) or not all(isinstance(name, str) for name in names):
        raise ParameterError(f'methods = {names!r} is no list of names: expected such as  ["mend", "chain.toml"]')
    if not isinstance(tables, list) or not all(isinstance(table, dict) for table in tables):
        raise ParameterError('method is no list of tables: expected [[method]] and a line such as  method = "mend"')
    for name in names:
        yield f"methods, {name}", {"recipe" if name.endswith(".toml") else "method": name}
    for number, table in enumerate(tables, 1):
        yield f"[[method]] {number}", table


def _placed(place: str, cases: Iterator[Case]) -> Iterator[Case]:
    """The same, its errors naming the place."""
    try:
        yield from cases
    except ParameterError as error:
        raise ParameterError(f"{place}: {error}") from None


def _cases(
    table: Mapping[str, Any], folder: Path, stop: Mapping[str, Any], boundary: Mapping[str, Any]
) -> Iterator[Case]:
    """A case for each choice from the lists of a method's table; the last list changes first."""
    check_keys("the method's table", table, ("method", "recipe", "title", "parameters", "stop"))
    named = [key for key in ("method", "recipe") if key in table]
    if len(named) != 1:
        raise ParameterError(f'it has {" and ".join(named) or "no method"}: expected one line such as  method = "mend"')
    for key in (*named, "title"):
        if not isinstance(table.get(key, ""), str):
            raise ParameterError(f"{key} = {table[key]!r} is no text: expected it in quotes")
    stops = _plain(stop) | _plain(table_in(table, "stop"))
    if "recipe" in table:
        if "parameters" in table:
            raise ParameterError("a recipe has values of its own: leave out parameters, or change the recipe")
        recipe = read_recipe(folder / table["recipe"])
        for limits, words in _choices(stops):
            from_values(StoppingCriteria, limits, owner="stop")
            yield Case(table.get("title", recipe.title) + words, recipe.limited(**limits))
        return
    method = METHODS[table["method"]]
    known = {one.name for one in declared(method)}
    for key in boundary:
        if key not in known:
            raise ParameterError(f"[boundary] {key}: {method.name} knows fixed boundaries alone")
    for values, words in _choices(dict(boundary) | _plain(table_in(table, "parameters"))):
        smoother = from_values(method, values, owner=method.name)
        for limits, more in _choices(stops):
            name = table.get("title", method.name) + words + more
            yield Case(name, smoother, from_values(StoppingCriteria, limits, owner="stop"))


def _plain(table: Mapping[str, Any]) -> dict[str, Any]:
    return {key.replace("-", "_"): value for key, value in table.items()}


def _choices(table: Mapping[str, Any]) -> Iterator[tuple[dict[str, Any], str]]:
    """Every choice of one value from each list of a table, with the chosen ones in words."""
    for key, value in table.items():
        if value == []:
            raise ParameterError(f"{key} = [] leaves nothing to be done: expected one value at least")
    lists = [value if isinstance(value, list) else [value] for value in table.values()]
    for values in itertools.product(*lists):
        chosen = dict(zip(table, values, strict=True))
        yield chosen, "".join(f" {key}={chosen[key]}" for key, value in table.items() if isinstance(value, list))
