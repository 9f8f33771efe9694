"""Recipe of a study as TOML: methods, lists of values whose combinations are run, and limits; study-many.md.

Files are data: nothing in them is executed.

Mesh files in folders.
"""

from __future__ import annotations

import dataclasses
import itertools
import os
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from hexmend.errors import FileError, ParameterError
from hexmend.io import readable_suffixes
from hexmend.io.format_lookup import format_by_place
from hexmend.io.formats.vtk.pvtu import piece_paths
from hexmend.io.storage.toml_files import read_toml
from hexmend.mesh.rules import MotionRules
from hexmend.parameters import declared, from_values
from hexmend.run import StoppingCriteria
from hexmend.run.recipe import Recipe, check_format, check_keys, read_table
from hexmend.run.recipe_files import read_recipe
from hexmend.smoothers import METHODS
from hexmend.study.batch.case import Case, TaskLimits
from hexmend.toml_text import parse_toml

#: Most cases of one study.
MAX_CASES = 10_000

#: Keys of the recipe of a study.
_KEYS = ("format", "title", "methods", "method", "stop", "task", "boundary", "motion")

#: Placeholder for the name of the mesh in that of its surface.
MESH_NAME = "{mesh}"


@dataclass(frozen=True)
class Plan:
    """Cases and limits of a study.

    Parameters
    ----------
    title : str
    cases : tuple of Case
        With unique names.
    limits : TaskLimits
        Limits of each task.
    surface : Path or None
        Surface on which the boundary slides, if not its own; `{mesh}` in it is the name of the mesh without suffix.
    """

    title: str
    cases: tuple[Case, ...]
    limits: TaskLimits = field(default_factory=TaskLimits)
    surface: Path | None = None

    def surface_of(self, mesh: Path) -> Path | None:
        """Return the path of the surface for a mesh."""
        return None if self.surface is None else Path(str(self.surface).replace(MESH_NAME, mesh.stem))


def read_plan(path: str | os.PathLike[str]) -> Plan:
    """Read the recipe of a study. Paths of recipes and surfaces in it are relative to its folder.

    Parameters
    ----------
    path : path-like

    Returns
    -------
    Plan

    Raises
    ------
    FileError
        If it, or a recipe that it names, cannot be read or is malformed; names the line, or the table and the key.
    """
    path = Path(path)
    return read_toml(path, "a recipe", lambda text: parse_plan(text, path.parent, path.stem))


def parse_plan(text: str, folder: Path, title: str = "Study") -> Plan:
    """Parse the recipe of a study.

    Parameters
    ----------
    text : str
    folder : Path
        Folder of the files that it names.
    title : str
        Title of a recipe without one.

    Returns
    -------
    Plan

    Raises
    ------
    ParameterError
        For malformed TOML (names the line) or values (names table, key and what was expected).

    Examples
    --------
    >>> plan = parse_plan('''
    ... format = 1
    ... methods = ["laplacian"]
    ... [[method]]
    ... method = "local-sd"
    ... parameters = { p = [2, 4], delta = 0.1 }
    ... stop = { max_iterations = [50, 100] }
    ... ''', Path("."))
    >>> [case.name for case in plan.cases][:3]
    ['laplacian', 'local-sd p=2 max_iterations=50', 'local-sd p=2 max_iterations=100']
    """
    data = parse_toml(text, "a recipe")
    check_format(data)
    check_keys("the study", data, _KEYS)
    if not isinstance(title := data.get("title", title), str):
        raise ParameterError(f"title = {title!r} is not a text: expected a title in quotes")
    stop, boundary = read_table(data, "stop"), _boundary(read_table(data, "boundary"))
    motion = read_table(data, "motion")
    MotionRules.from_values(motion)  # an error of the study, not of its first method
    surface = boundary.pop("surface", None)
    found = (
        _with_rules(case, motion)
        for place, table in _tables(data)
        for case in _locate_errors(place, _cases(table, folder, stop, boundary))
    )
    cases = tuple(itertools.islice(found, MAX_CASES + 1))
    if not cases:
        raise ParameterError('the study has no method: expected a line such as  methods = ["mend", "getme"]')
    if len(cases) > MAX_CASES:
        raise ParameterError(f"the combinations of the lists are more than {MAX_CASES:,} cases: shorten them")
    for name, count in Counter(case.name for case in cases).items():
        if count > 1:
            raise ParameterError(f"two of the methods would be called {name!r} in tables: give each of them a  title")
    if surface is not None and not any(case.slides for case in cases):
        raise ParameterError("a surface is given, but the boundary is fixed: set boundary = 'slide'")
    limits = from_values(TaskLimits, read_table(data, "task"), owner="task")
    return Plan(title, cases, limits, None if surface is None else folder / surface)


def _with_rules(case: Case, motion: Mapping[str, Any]) -> Case:
    """Return a case with the rules of motion of the study, in addition to those of its recipe."""
    if not motion:
        return case
    rules, interfaces = MotionRules.from_values(motion), motion.get("interfaces")
    if not isinstance(case.smoother, Recipe):
        return dataclasses.replace(case, rules=rules)
    return dataclasses.replace(case, smoother=case.smoother.with_more_rules(rules, interfaces))


def _boundary(table: Mapping[str, Any]) -> dict[str, Any]:
    check_keys("[boundary]", table, ("boundary", "surface", "surface_tolerance"))
    if not isinstance(surface := table.get("surface", ""), str):
        raise ParameterError(f"surface = {surface!r} is not a text: expected the name of a file in quotes")
    return ({"boundary": "slide"} if surface else {}) | dict(table)


def _tables(data: Mapping[str, Any]) -> Iterator[tuple[str, Mapping[str, Any]]]:
    """Yield the table of each method, with its place in the file."""
    names, tables = data.get("methods", []), data.get("method", [])
    if not isinstance(names, list) or not all(isinstance(name, str) for name in names):
        raise ParameterError(f'methods = {names!r} is not a list of names: expected such as  ["mend", "chain.toml"]')
    if not isinstance(tables, list) or not all(isinstance(table, dict) for table in tables):
        raise ParameterError('method is not a list of tables: expected [[method]] and a line such as  method = "mend"')
    for name in names:
        yield f"methods, {name}", {"recipe" if name.endswith(".toml") else "method": name}
    for number, table in enumerate(tables, 1):
        yield f"[[method]] {number}", table


def _locate_errors(place: str, cases: Iterator[Case]) -> Iterator[Case]:
    """Yield the cases; errors name the place."""
    try:
        yield from cases
    except ParameterError as error:
        raise ParameterError(f"{place}: {error}") from None


def _cases(
    table: Mapping[str, Any], folder: Path, stop: Mapping[str, Any], boundary: Mapping[str, Any]
) -> Iterator[Case]:
    """Yield a case for each combination of the lists in the table of a method; the last list changes first."""
    check_keys("the method's table", table, ("method", "recipe", "title", "parameters", "stop"))
    named = [key for key in ("method", "recipe") if key in table]
    if len(named) != 1:
        raise ParameterError(f'it has {" and ".join(named) or "no method"}: expected one line such as  method = "mend"')
    for key in (*named, "title"):
        if not isinstance(table.get(key, ""), str):
            raise ParameterError(f"{key} = {table[key]!r} is not a text: expected it in quotes")
    stops = _underscored(stop) | _underscored(read_table(table, "stop"))
    if "recipe" in table:
        if "parameters" in table:
            raise ParameterError("a recipe has values of its own: leave out parameters, or change the recipe")
        recipe = read_recipe(folder / table["recipe"])
        for limits, words in _choices(stops):
            from_values(StoppingCriteria, limits, owner="stop")  # refuses unknown limits
            yield Case(table.get("title", recipe.title) + words, recipe.limited(**limits))
        return
    method = METHODS[table["method"]]
    known = {parameter.name for parameter in declared(method)}
    for key in boundary:
        if key not in known:
            raise ParameterError(f"[boundary] {key}: {method.name} keeps the boundary fixed")
    for values, words in _choices(dict(boundary) | _underscored(read_table(table, "parameters"))):
        smoother = from_values(method, values, owner=method.name)
        for limits, more in _choices(stops):
            name = table.get("title", method.name) + words + more
            yield Case(name, smoother, from_values(StoppingCriteria, limits, owner="stop"))


def _underscored(table: Mapping[str, Any]) -> dict[str, Any]:
    return {key.replace("-", "_"): value for key, value in table.items()}


def _choices(table: Mapping[str, Any]) -> Iterator[tuple[dict[str, Any], str]]:
    """Yield each combination of one value from each list of a table, and its values as text."""
    for key, value in table.items():
        if value == []:
            raise ParameterError(f"{key} = [] leaves nothing to run: expected at least one value")
    lists = [value if isinstance(value, list) else [value] for value in table.values()]
    for values in itertools.product(*lists):
        choice = dict(zip(table, values, strict=True))
        yield choice, "".join(f" {key}={choice[key]}" for key, value in table.items() if isinstance(value, list))


def find_meshes(places: Iterable[Path]) -> list[Path]:
    """List the meshes of folders and their subfolders, in the order of names, and those that are named themselves.

    Parameters
    ----------
    places : iterable of Path
        Folders, files, or folders that are one mesh, such as OpenFOAM cases.

    Returns
    -------
    list of Path
        Files with a suffix of a mesh, and folders that are a mesh; no pieces of PVTU files of the same folder.

    Raises
    ------
    FileError
        For a place that does not exist, and for a folder without meshes.
    """
    found: list[Path] = []
    for place in places:
        if not place.exists():
            raise FileError(place, "there is no such file or folder", "Choose a folder of meshes, or mesh files.")
        meshes = _without_pieces(list(_meshes_in(place))) if place.is_dir() else [place]
        if not meshes:
            raise FileError(place, "no mesh is in this folder", f"Expected files {', '.join(readable_suffixes())}.")
        found += meshes
    return list(dict.fromkeys(found))


def _meshes_in(folder: Path) -> Iterator[Path]:
    """Yield the meshes in a folder, which may itself be one."""
    if format_by_place(folder) is not None:
        yield folder
        return
    for path in sorted(folder.iterdir()):
        if path.is_dir():
            yield from () if path.name.startswith(".") else _meshes_in(path)
        elif path.suffix.lower() in readable_suffixes() and not path.name.startswith("."):
            yield path


def _without_pieces(meshes: list[Path]) -> list[Path]:
    """Leave out the files that others among them name as their pieces."""
    pieces: set[Path] = set()
    for path in meshes:
        if path.suffix.lower() == ".pvtu":
            with suppress(FileError, OSError):  # reading it tells what is wrong
                pieces.update(piece_paths(path))
    return [path for path in meshes if path not in pieces]
