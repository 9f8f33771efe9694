"""What the user has done to the mesh, as data: whoever tells of it, such as a script, listens to `Commands.done`."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from hexmend_app.state.document import State
from hexmend_app.state.scene import Scene


@dataclass(frozen=True, eq=False)
class Changed:
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
class Moved:
    """The nodes were put to where they are in another state."""

    title: str
    before: State
    after: State
    places: State


@dataclass(frozen=True, eq=False)
class WentBack:
    """What was done was taken back (`undone`), or what was taken back was done again."""

    title: str
    now: State
    undone: bool


@dataclass(frozen=True, eq=False)
class Saved:
    """The mesh was written to a file, or, where `session`, all there is."""

    path: Path
    now: State
    session: bool


@dataclass(frozen=True, eq=False)
class Drawn:
    """What is seen was written as a picture.

    Parameters
    ----------
    path : Path
    now : State
    scene : Scene
    alone : bool
        Whether the picture shows nothing but the mesh as it is.
    """

    path: Path
    now: State
    scene: Scene
    alone: bool


Deed = Changed | Moved | WentBack | Saved | Drawn
