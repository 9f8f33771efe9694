"""Reading and writing of sessions.

The file is an archive, see `hexmend_app.formats.session`. The viewer defines the data under the key "window".
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from hexmend.errors import FileError, MeshError
from hexmend.io.files import check_readable, reading
from hexmend.mesh.mesh import Mesh
from hexmend_app.formats.session.archive import read_archive, write_archive
from hexmend_app.formats.session.mesh_data import MeshDecoder, check_fields, mesh_to_data

#: Version of the format.
VERSION = 1
#: Largest number of meshes in a session.
MAX_MESHES = 10_000

_FORMAT = "Hexmend session"


@dataclass(frozen=True, eq=False)
class SessionContent:
    """Content of a session file.

    Parameters
    ----------
    meshes : tuple of Mesh
    now : int
        Index of the mesh that was shown.
    window : object
        State of the window: plain data with arrays, see `write_archive`.
    """

    meshes: tuple[Mesh, ...]
    now: int
    window: Any


def write_session(path: str | Path, meshes: Sequence[Mesh], now: int, window: Any) -> None:
    """Write a session. For an atomic replacement call it in `atomic_write`.

    Parameters
    ----------
    path : path-like
    meshes : sequence of Mesh
        Arrays that they share are written once.
    now : int
        Index of the mesh that is shown.
    window : object
        State of the window: plain data with arrays.
    """
    write_archive(path, _FORMAT, VERSION, _tree(meshes, now, window))


def _tree(meshes: Sequence[Mesh], now: int, window: Any) -> dict[str, Any]:
    return {"meshes": [mesh_to_data(mesh) for mesh in meshes], "now": now, "window": window}


def read_session(path: str | Path) -> SessionContent:
    """Read a session from a file.

    Parameters
    ----------
    path : path-like

    Returns
    -------
    SessionContent

    Raises
    ------
    FileError
        For another file, a damaged one, and another version.
    """
    with _opened(path) as (data, now):
        decoder = MeshDecoder()
        meshes = tuple(decoder.decode(mesh) for mesh in data["meshes"])
        return SessionContent(meshes, now, data["window"])


def read_shown_mesh(path: Path) -> Mesh:
    """Read the mesh that was shown; raises `FileError` as `read_session`."""
    with _opened(path) as (data, now):
        return MeshDecoder().decode(data["meshes"][now])


@contextmanager
def _opened(path: str | Path) -> Iterator[tuple[Any, int]]:
    """Context manager that gives a session's data and index shown; invalid meshes become a `FileError`."""
    check_readable(Path(path), "a session")
    with reading(Path(path), "Close other programs."):
        data = read_archive(path, _FORMAT, VERSION)
    try:
        yield data, _shown_index(data)
    except MeshError as error:
        raise FileError(path, str(error), "Use an earlier copy, or open the mesh that it was made from.") from None


def _shown_index(data: Any) -> int:
    """Check the fields of a session; returns the index of the mesh that was shown."""
    check_fields("the session", data, {"meshes", "now", "window"})
    meshes, now = data["meshes"], data["now"]
    if not isinstance(meshes, list) or type(now) is not int or not 0 <= now < len(meshes):
        raise MeshError("it does not say which of its meshes was shown")
    if len(meshes) > MAX_MESHES:
        raise MeshError(f"it has {len(meshes):,} meshes: expected {MAX_MESHES:,} at most")
    return now
