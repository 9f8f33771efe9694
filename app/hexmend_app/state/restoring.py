"""What a picture shows, read again: its mesh, and the others that stand beside it there."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from enum import Enum
from pathlib import Path, PurePosixPath

import numpy as np

from hexmend.errors import FileError, HexmendError, ParameterError
from hexmend.io import read
from hexmend.mesh.mesh import Mesh
from hexmend_app.state.document import State
from hexmend_app.state.look import Look
from hexmend_app.state.scene.carried import Carried, Pictured, digest
from hexmend_app.state.views import MOST, NOW


class Lack(Enum):
    """Why a mesh of a picture cannot be shown, or is another than there."""

    ROOM = "room"
    FILE = "file"
    READING = "reading"
    RUN = "run"
    """It is an iteration or a result of a run on its file, which has it as it was before."""
    HEXES = "hexes"
    """It has others than the first mesh."""
    PLACES = "places"
    """It is shown, its nodes elsewhere than in the picture."""


@dataclass(frozen=True, eq=False)
class Beside:
    """Another mesh of a picture.

    Parameters
    ----------
    name : str
        What the picture calls it.
    file : str
        The name of its file, as far as it is known.
    state : State or None
        Of the same hexes as the first mesh; None where it cannot be shown beside that.
    lack : Lack or None
    error : HexmendError or None
        Where it cannot be read.
    path : Path or None
        Of its file; None where it is not shown.
    """

    name: str
    file: str
    state: State | None = None
    lack: Lack | None = None
    error: HexmendError | None = None
    path: Path | None = None


@dataclass(frozen=True, eq=False)
class Restored:
    """What a picture shows.

    Parameters
    ----------
    picture : Path
    carried : Carried
    path : Path
        Of the mesh's file.
    state : State
        The mesh of that.
    look : Look
        How the picture has it looked at.
    digest : str
        Of the mesh.
    others : tuple of Beside
        What the picture shows besides, in its order.
    """

    picture: Path
    carried: Carried
    path: Path
    state: State
    look: Look
    digest: str
    others: tuple[Beside, ...] = ()

    @property
    def alike(self) -> bool:
        """Whether the meshes are those that the picture shows, be it before what ran on the first."""
        mine = self.digest in (self.carried.first.opened, self.carried.first.shown)
        return mine and all(one.lack in (None, Lack.ROOM, Lack.RUN) for one in self.others)

    @property
    def wiped(self) -> float | None:
        """Where the edge is, as a share of the width, where the picture has the other mesh wiped over the first."""
        panels = self.carried.panels
        wipe = panels[0].wipe if len(panels) == 1 else None
        return wipe.at if wipe is not None and any(one.state for one in self.others) else None


@dataclass(frozen=True, eq=False)
class Wanting:
    """A picture whose mesh is not where it was: somebody has to say where it is."""

    picture: Path
    carried: Carried


def restored(wanting: Wanting, path: Path, states: Iterable[State], reads: Callable[[Path], object]) -> Restored:
    """What a picture shows of a mesh, and the others that it shows.

    Parameters
    ----------
    wanting : Wanting
    path : Path
        Of the mesh.
    states : iterable of State
        What the file holds of it: one, or, of a session, many, of which the first is taken where none is the picture's.
    reads : callable
        Told of every other file that is read.

    Raises
    ------
    FileError
        Where the picture cannot be one of the mesh.
    """
    picture, carried = wanting.picture, wanting.carried
    known = _known(states)
    state = known.get(carried.first.shown) or next(iter(known.values()))
    try:
        look = carried.scene.look(state.mesh)
    except ParameterError as error:
        raise FileError(picture, f"shows another mesh than {path.name}: {error}", "Name its mesh.") from None
    named = _named(carried)
    first, *rest = named
    others = []
    for number in rest:
        pictured, name = carried.meshes[number - 1], named[number]
        if len(others) == MOST:
            others.append(Beside(name, PurePosixPath(pictured.file).name, lack=Lack.ROOM))
        elif pictured.file and pictured.file == carried.meshes[first - 1].file:
            others.append(_beside(name, pictured, path, known.get(pictured.shown, state), state))
        else:
            others.append(_read(name, pictured, picture, state, reads))
    return Restored(picture, carried, path, state, look, digest(state.mesh), tuple(others))


def _known(states: Iterable[State]) -> dict[str, State]:
    """States by the digests of their meshes; of equal ones the first."""
    known: dict[str, State] = {}
    for state in {id(one): one for one in states}.values():
        known.setdefault(digest(state.mesh), state)
    return known


def _named(carried: Carried) -> dict[int, str]:
    """The meshes that are seen, by number, in the order of the picture, and what they are called there."""
    found: dict[int, str] = {}
    taken = {NOW}  # by the view of the first
    for panel in carried.panels:
        for one in (panel,) if panel.wipe is None else (panel, panel.wipe):
            called = one.caption or PurePosixPath(carried.meshes[one.mesh - 1].file).stem or str(one.mesh)
            if one.mesh not in found:
                names = (called, *(f"{called} ({k})" for k in range(2, len(carried.meshes) + 2)))
                found[one.mesh] = next(name for name in names if not found or name not in taken)
                taken.add(found[one.mesh])
    return found


def _read(name: str, pictured: Pictured, picture: Path, first: State, reads: Callable[[Path], object]) -> Beside:
    """Another mesh from its own file."""
    paths = pictured.candidates(picture)
    if not paths:
        return Beside(name, pictured.file, lack=Lack.FILE)
    reads(paths[0])
    try:
        state = State.of(read(paths[0]))
    except HexmendError as error:
        return Beside(name, paths[0].name, lack=Lack.READING, error=error)
    return _beside(name, pictured, paths[0], state, first)


def _beside(name: str, pictured: Pictured, path: Path, state: State, first: State) -> Beside:
    """What of a mesh can stand beside the first."""
    known = digest(state.mesh)
    if known == pictured.opened != pictured.shown:
        return Beside(name, path.name, lack=Lack.RUN)
    if not _same(state.mesh, first.mesh):
        return Beside(name, path.name, lack=Lack.HEXES)
    shared = replace(state, mesh=first.mesh.with_points(state.mesh.points))
    return Beside(name, path.name, shared, None if known == pictured.shown else Lack.PLACES, path=path)


def _same(one: Mesh, other: Mesh) -> bool:
    """Whether two meshes have the same hexes of as many nodes."""
    return one.n_nodes == other.n_nodes and np.array_equal(one.hexes, other.hexes)
