"""Events of the user's changes and exports, as data: scripts are written from them (`Commands.done`)."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from hexmend.boundary.displacement import Displacement
from hexmend_app.state.mesh.document import State
from hexmend_app.state.mesh.run_record import RunRecord

if TYPE_CHECKING:
    from hexmend_app.state.session.session_data import SessionData


@dataclass(frozen=True, eq=False)
class MeshEdited:
    """A function of the core has changed what the mesh is or carries.

    Parameters
    ----------
    title : str
    before, after : State
    change : callable
        Takes the mesh before and `values`.
    values : tuple
        Text, switches, whole numbers or arrays of them.
    """

    title: str
    before: State
    after: State
    change: Callable[..., Any]
    values: tuple[Any, ...] = ()


@dataclass(frozen=True, eq=False)
class NodesMoved:
    """The nodes were put to where they are in another state."""

    title: str
    before: State
    after: State
    places: State


@dataclass(frozen=True, eq=False)
class UndoOrRedo:
    """A change was undone (`undone`) or redone."""

    title: str
    now: State
    undone: bool


@dataclass(frozen=True, eq=False)
class MeshSaved:
    """The mesh was written to a file, or the session.

    Parameters
    ----------
    path : Path
    now : State
        The mesh as it was shown when that was asked for.
    data : SessionData or None
        What was written of the session; None for a file of the mesh alone.
    """

    path: Path
    now: State
    data: SessionData | None = None


@dataclass(frozen=True, eq=False)
class FileExported:
    """A function writes a file, or a folder of them: the same call from a script writes the same.

    Parameters
    ----------
    title : str
    function : callable
        Of a module that needs no window.
    values : tuple
        What it is called with: paths, text, numbers, scenes, recipes, rows of a comparison, runs, and states of the
        mesh, which stand for their meshes; also in lists and tuples.
    options : mapping
        The same by name.
    """

    title: str
    function: Callable[..., Any]
    values: tuple[Any, ...]
    options: Mapping[str, Any] = field(default_factory=dict)

    @property
    def given(self) -> tuple[Any, ...]:
        """The values as the function takes them."""
        return _given(self.values)

    def perform(self) -> None:
        """Write it; raises what the function does."""
        self.function(*self.given, **{name: _given(one) for name, one in self.options.items()})


@dataclass(frozen=True, eq=False)
class IterationsExported:
    """A run of which somebody wants to know where the nodes were at some iterations; to functions, the run."""

    record: RunRecord
    numbers: Sequence[int]


@dataclass(frozen=True, eq=False)
class TableExported:
    """The comparison of methods was written as a table, with other names for methods and another title, or its own."""

    path: Path
    names: Mapping[str, str] | None = None
    title: str | None = None


def displacement_since(movement: Displacement | None, opened: State) -> dict[str, Any]:
    """Return the arguments of drawing functions for the displacement shown and for the mesh as opened."""
    if movement is None:
        return {}
    since = opened.mesh.with_points(movement.before.points)
    return {"opened": opened, "since": since, "since_name": movement.before.name}


def _given(value: Any) -> Any:
    """Return the argument of a function for a value of an event."""
    if isinstance(value, list | tuple):
        return type(value)(map(_given, value))
    if isinstance(value, IterationsExported):
        return value.record
    return value.mesh if isinstance(value, State) else value


UserEvent = MeshEdited | NodesMoved | UndoOrRedo | MeshSaved | FileExported | TableExported
