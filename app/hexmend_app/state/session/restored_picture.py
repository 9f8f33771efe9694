"""Restoring of what a picture shows: its mesh, and the meshes in side views."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from enum import Enum
from pathlib import Path, PurePosixPath

import numpy as np

from hexmend.errors import FileError, HexmendError, ParameterError
from hexmend.io import read
from hexmend.mesh.mesh import Mesh
from hexmend_app.picture.appearance import Look
from hexmend_app.picture.picture_metadata import PicturedMesh, PictureMetadata, digest
from hexmend_app.state.mesh.document import State
from hexmend_app.state.view.side_views import MOST, NOW


class RestoreProblem(Enum):
    """Why a mesh of a picture cannot be shown, or is another than there."""

    NO_SPACE = "room"
    FILE = "file"
    READING = "reading"
    RUN = "run"
    """It is an iteration or a result of a run on its file, which has it as it was before."""
    HEXES = "hexes"
    """It has others than the first mesh."""
    PLACES = "places"
    """It is shown, its nodes elsewhere than in the picture."""


@dataclass(frozen=True, eq=False)
class RestoredMesh:
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
    lack: RestoreProblem | None = None
    error: HexmendError | None = None
    path: Path | None = None


@dataclass(frozen=True, eq=False)
class RestoredPicture:
    """Content of a picture, restored.

    Parameters
    ----------
    picture : Path
    metadata : PictureMetadata
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
    metadata: PictureMetadata
    path: Path
    state: State
    look: Look
    digest: str
    others: tuple[RestoredMesh, ...] = ()

    @property
    def alike(self) -> bool:
        """True if the meshes are those that the picture shows, or the first is as before the runs on it."""
        mine = self.digest in (self.metadata.first.opened, self.metadata.first.shown)
        return mine and all(one.lack in (None, RestoreProblem.NO_SPACE, RestoreProblem.RUN) for one in self.others)

    @property
    def wiped(self) -> float | None:
        """Position of the wipe's edge, as a share of the width, if the picture shows a wipe."""
        panels = self.metadata.panels
        wipe = panels[0].wipe if len(panels) == 1 else None
        return wipe.at if wipe is not None and any(one.state for one in self.others) else None


@dataclass(frozen=True, eq=False)
class MissingMesh:
    """A picture whose mesh is not where it was: somebody has to say where it is."""

    picture: Path
    metadata: PictureMetadata


def restore_picture(
    wanting: MissingMesh, path: Path, states: Iterable[State], reads: Callable[[Path], object]
) -> RestoredPicture:
    """Restore a mesh that a picture shows, and the other meshes in it.

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
    picture, metadata = wanting.picture, wanting.metadata
    known = _known(states)
    state = known.get(metadata.first.shown) or next(iter(known.values()))
    try:
        look = metadata.scene.look(state.mesh)
    except ParameterError as error:
        raise FileError(picture, f"shows another mesh than {path.name}: {error}", "Name its mesh.") from None
    named = _named(metadata)
    first, *rest = named
    others = []
    for number in rest:
        pictured, name = metadata.meshes[number - 1], named[number]
        if len(others) == MOST:
            others.append(RestoredMesh(name, PurePosixPath(pictured.file).name, lack=RestoreProblem.NO_SPACE))
        elif pictured.file and pictured.file == metadata.meshes[first - 1].file:
            others.append(_neighbour(name, pictured, path, known.get(pictured.shown, state), state))
        else:
            others.append(_read(name, pictured, picture, state, reads))
    return RestoredPicture(picture, metadata, path, state, look, digest(state.mesh), tuple(others))


def _known(states: Iterable[State]) -> dict[str, State]:
    """States by the digests of their meshes; of equal ones the first."""
    known: dict[str, State] = {}
    for state in {id(one): one for one in states}.values():
        known.setdefault(digest(state.mesh), state)
    return known


def _named(metadata: PictureMetadata) -> dict[int, str]:
    """The meshes that are seen, by number, in the order of the picture, and what they are called there."""
    found: dict[int, str] = {}
    taken = {NOW}  # by the view of the first
    for panel in metadata.panels:
        for one in (panel,) if panel.wipe is None else (panel, panel.wipe):
            called = one.caption or PurePosixPath(metadata.meshes[one.mesh - 1].file).stem or str(one.mesh)
            if one.mesh not in found:
                names = (called, *(f"{called} ({k})" for k in range(2, len(metadata.meshes) + 2)))
                found[one.mesh] = next(name for name in names if not found or name not in taken)
                taken.add(found[one.mesh])
    return found


def _read(
    name: str, pictured: PicturedMesh, picture: Path, first: State, reads: Callable[[Path], object]
) -> RestoredMesh:
    """Another mesh from its own file."""
    paths = pictured.candidates(picture)
    if not paths:
        return RestoredMesh(name, pictured.file, lack=RestoreProblem.FILE)
    reads(paths[0])
    try:
        state = State.of(read(paths[0]))
    except HexmendError as error:
        return RestoredMesh(name, paths[0].name, lack=RestoreProblem.READING, error=error)
    return _neighbour(name, pictured, paths[0], state, first)


def _neighbour(name: str, pictured: PicturedMesh, path: Path, state: State, first: State) -> RestoredMesh:
    """Restore a mesh that is shown in a side view."""
    known = digest(state.mesh)
    if known == pictured.opened != pictured.shown:
        return RestoredMesh(name, path.name, lack=RestoreProblem.RUN)
    if not _same(state.mesh, first.mesh):
        return RestoredMesh(name, path.name, lack=RestoreProblem.HEXES)
    shared = replace(state, mesh=first.mesh.with_points(state.mesh.points))
    return RestoredMesh(name, path.name, shared, None if known == pictured.shown else RestoreProblem.PLACES, path=path)


def _same(one: Mesh, other: Mesh) -> bool:
    """Return True if two meshes have the same hexes and the same number of nodes."""
    return one.n_nodes == other.n_nodes and np.array_equal(one.hexes, other.hexes)
