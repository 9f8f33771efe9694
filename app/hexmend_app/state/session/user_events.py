"""The user's changes and exports as events, from which scripts are recorded (`SessionParts.user_event`)."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from hexmend_app.picture.displacement import Displacement
from hexmend_app.state.mesh.document import State
from hexmend_app.state.mesh.run_record import RunRecord

if TYPE_CHECKING:
    from hexmend_app.state.session.session_data import SessionData


@dataclass(frozen=True, eq=False)
class MeshEdited:
    """A function of the core has changed the mesh, its pins or its tags.

    Parameters
    ----------
    title : str
    before, after : State
    change : callable
        Function of the mesh before the change and `values`.
    values : tuple
        Strings, booleans, numbers, None or arrays of integers.
    """

    title: str
    before: State
    after: State
    change: Callable[..., Any]
    values: tuple[Any, ...] = ()


@dataclass(frozen=True, eq=False)
class NodesMoved:
    """The nodes were moved to their positions in another state, `source`."""

    title: str
    before: State
    after: State
    source: State


@dataclass(frozen=True, eq=False)
class UndoOrRedo:
    """A change was undone (`undone`) or redone."""

    title: str
    now: State
    undone: bool


@dataclass(frozen=True, eq=False)
class MeshSaved:
    """The mesh or the session was written to a file.

    Parameters
    ----------
    path : Path
    now : State
        The state shown when the user saved.
    data : SessionData or None
        The data of the session; None for a mesh file.
    like : Path or None
        File whose coordinates were replaced in a copy; None for a file written anew.
    """

    path: Path
    now: State
    data: SessionData | None = None
    like: Path | None = None


@dataclass(frozen=True, eq=False)
class FileExported:
    """Export of files by a function; the same call in a script writes the same files.

    Parameters
    ----------
    title : str
    function : callable
        Function of a module that needs no window.
    values : tuple
        Positional arguments: paths, strings, numbers, scenes, recipes, rows of a comparison, runs, and states, which
        are replaced by their meshes; also in lists and tuples.
    options : mapping
        Keyword arguments of the same types.
    """

    title: str
    function: Callable[..., Any]
    values: tuple[Any, ...]
    options: Mapping[str, Any] = field(default_factory=dict)

    @property
    def arguments(self) -> tuple[Any, ...]:
        """Positional arguments of the function."""
        return _argument(self.values)

    def perform(self) -> Any:
        """Call the function, which writes the files, and return its value; its errors are passed on."""
        return self.function(*self.arguments, **{name: _argument(value) for name, value in self.options.items()})


@dataclass(frozen=True, eq=False)
class IterationsExported:
    """Argument of an export: a run, with the numbers of the iterations whose node positions it needs."""

    record: RunRecord
    numbers: Sequence[int]


@dataclass(frozen=True, eq=False)
class TableExported:
    """The comparison of methods was written as a table, optionally with other names of methods and another title."""

    path: Path
    names: Mapping[str, str] | None = None
    title: str | None = None


def displacement_since(movement: Displacement | None, opened: State) -> dict[str, Any]:
    """Return the arguments of drawing functions that describe the displacement shown; empty if there is none."""
    if movement is None:
        return {}
    since = opened.mesh.with_points(movement.before.points)
    return {"opened": opened, "since": since, "since_name": movement.before.name}


def _argument(value: Any) -> Any:
    """Return the argument of a function for a value of an event."""
    if isinstance(value, list | tuple):
        return type(value)(map(_argument, value))
    if isinstance(value, IterationsExported):
        return value.record
    return value.mesh if isinstance(value, State) else value


UserEvent = MeshEdited | NodesMoved | UndoOrRedo | MeshSaved | FileExported | TableExported
