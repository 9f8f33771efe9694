"""Restoring the content of a picture: its mesh, and the meshes in side views."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from pathlib import Path, PurePosixPath

import numpy as np

from hexmend.errors import FileError, HexmendError, ParameterError
from hexmend.io import read
from hexmend.mesh.mesh import Mesh
from hexmend_app.picture.appearance import Look
from hexmend_app.picture.picture_metadata import PicturedMesh, PictureMetadata, digest
from hexmend_app.state.mesh.document import MeasuredMesh
from hexmend_app.state.view.side_views import MAX_SIDE_VIEWS, NOW
from hexmend_app.translation import tr


@dataclass(frozen=True, eq=False)
class RestoredMesh:
    """Mesh of a picture other than the first.

    Parameters
    ----------
    name : str
        Name in the picture.
    state : MeasuredMesh or None
        State with the hexes of the first mesh; None if the mesh cannot be shown next to it.
    problem : str
        Why the mesh cannot be shown, or how it differs from the picture; "" if neither applies.
    is_expected : bool
        The problem is due to the window or to a run, not to a file that has changed.
    """

    name: str
    state: MeasuredMesh | None = None
    problem: str = ""
    is_expected: bool = False


@dataclass(frozen=True, eq=False)
class RestoredPicture:
    """Content of a picture, restored.

    Parameters
    ----------
    picture : Path
    metadata : PictureMetadata
    path : Path
        File of the first mesh.
    state : MeasuredMesh
        State of the first mesh.
    look : Look
        Appearance in the picture.
    digest : str
        Digest of the first mesh.
    others : tuple of RestoredMesh
        The other meshes, in the order of the picture.
    """

    picture: Path
    metadata: PictureMetadata
    path: Path
    state: MeasuredMesh
    look: Look
    digest: str
    others: tuple[RestoredMesh, ...] = ()

    @property
    def matches(self) -> bool:
        """True if the picture shows these meshes; the first may also be the mesh before the run."""
        first_matches = self.digest in (self.metadata.first.opened, self.metadata.first.shown)
        return first_matches and all(mesh.is_expected or not mesh.problem for mesh in self.others)

    @property
    def wipe_position(self) -> float | None:
        """Position of the wipe's edge, as a share of the width, if the picture shows a wipe."""
        panels = self.metadata.panels
        wipe = panels[0].wipe if len(panels) == 1 else None
        return wipe.at if wipe is not None and any(mesh.state for mesh in self.others) else None


@dataclass(frozen=True, eq=False)
class MissingMesh:
    """Picture whose mesh file was not found: the user is asked for its path."""

    picture: Path
    metadata: PictureMetadata


def restore_picture(
    missing: MissingMesh, path: Path, states: Iterable[MeasuredMesh], on_read: Callable[[Path], object]
) -> RestoredPicture:
    """Restore the meshes of a picture.

    Parameters
    ----------
    missing : MissingMesh
    path : Path
        File of the first mesh.
    states : iterable of MeasuredMesh
        States in that file; a session may have several. If the picture shows none of them, the first is used.
    on_read : callable
        Called with the path of every other file before it is read.

    Raises
    ------
    FileError
        If the picture cannot show the mesh.
    """
    picture, metadata = missing.picture, missing.metadata
    states_by_digest = _by_digest(states)
    state = states_by_digest.get(metadata.first.shown) or next(iter(states_by_digest.values()))
    try:
        look = metadata.scene.look(state.mesh)
    except ParameterError as error:
        raise FileError(picture, f"shows another mesh than {path.name}: {error}", "Name its mesh.") from None
    names = _mesh_names(metadata)
    first, *rest = names
    others: list[RestoredMesh] = []
    no_space = tr("the window shows at most {views} views", views=MAX_SIDE_VIEWS + 1)
    for number in rest:
        pictured, name = metadata.meshes[number - 1], names[number]
        if len(others) == MAX_SIDE_VIEWS:
            others.append(RestoredMesh(name, None, no_space, is_expected=True))
        elif pictured.file and pictured.file == metadata.meshes[first - 1].file:
            others.append(_restore_mesh(name, pictured, path, states_by_digest.get(pictured.shown, state), state))
        else:
            others.append(_read_mesh(name, pictured, picture, state, on_read))
    return RestoredPicture(picture, metadata, path, state, look, digest(state.mesh), tuple(others))


def _by_digest(states: Iterable[MeasuredMesh]) -> dict[str, MeasuredMesh]:
    """Return states by the digests of their meshes; of states with equal meshes, the first."""
    result: dict[str, MeasuredMesh] = {}
    for state in dict.fromkeys(states):
        result.setdefault(digest(state.mesh), state)
    return result


def _mesh_names(metadata: PictureMetadata) -> dict[int, str]:
    """Return the unique names of the visible meshes by number, in the order of the picture."""
    names: dict[int, str] = {}
    used = {NOW}  # by the view of the first mesh
    for panel in metadata.panels:
        for view in (panel,) if panel.wipe is None else (panel, panel.wipe):
            stem = view.caption or PurePosixPath(metadata.meshes[view.mesh - 1].file).stem or str(view.mesh)
            if view.mesh not in names:
                candidates = (stem, *(f"{stem} ({k})" for k in range(2, len(metadata.meshes) + 2)))
                names[view.mesh] = next(name for name in candidates if not names or name not in used)
                used.add(names[view.mesh])
    return names


def _read_mesh(
    name: str, pictured: PicturedMesh, picture: Path, first: MeasuredMesh, on_read: Callable[[Path], object]
) -> RestoredMesh:
    """Read a mesh from its own file and restore it."""
    paths = pictured.candidates(picture)
    if not paths:
        missing = tr("{file} was not found", file=pictured.file)
        return RestoredMesh(
            name, None, missing if pictured.file else tr("the picture does not contain the name of its file")
        )
    on_read(paths[0])
    try:
        state = MeasuredMesh.of(read(paths[0]))
    except HexmendError as error:
        return RestoredMesh(name, None, str(error).rstrip("."))
    return _restore_mesh(name, pictured, paths[0], state, first)


def _restore_mesh(
    name: str, pictured: PicturedMesh, path: Path, state: MeasuredMesh, first: MeasuredMesh
) -> RestoredMesh:
    """Restore a mesh for a side view, with the hexes of the first mesh."""
    found, file = digest(state.mesh), path.name
    if found == pictured.opened != pictured.shown:
        of_run = tr("it is an iteration or a result of a run on {file}, which is not stored in that file", file=file)
        return RestoredMesh(name, None, of_run, is_expected=True)
    if not _same_hexes(state.mesh, first.mesh):
        other = tr("{file} has other hexes; side views must have the hexes of the main view", file=file)
        return RestoredMesh(name, None, other)
    shared = replace(state, mesh=first.mesh.with_points(state.mesh.points))
    moved = "" if found == pictured.shown else tr("{file} has other node positions", file=file)
    return RestoredMesh(name, shared, moved)


def _same_hexes(mesh: Mesh, other: Mesh) -> bool:
    """Return True if two meshes have the same hexes and the same number of nodes."""
    return mesh.n_nodes == other.n_nodes and np.array_equal(mesh.elements, other.elements)
