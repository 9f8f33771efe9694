"""Sessions (.hexmend): the meshes of a window, which of them is shown, and all that the window keeps beside them.

A zip, see `hexmend.io.archive`. To the core a session is the mesh as it was shown when it was saved: `read` gives
that one, with the surface that its boundary slides on. What stands under "window" is the viewer's.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from hexmend.aliases import exports
from hexmend.errors import FileError, MeshError
from hexmend.io.base.format import Format, register
from hexmend.mesh.mesh import Mesh

#: The suffix of sessions, and the number of what is written; lower ones can be read.
SUFFIX, VERSION = ".hexmend", 4
#: Meshes of one session: changes, runs and what they are compared with.
MOST = 10_000

_FORMAT = "Hexmend session"
_HEAD = b"PK\x03\x04", b"description.json"


@dataclass(frozen=True, eq=False)
class SessionContent:
    """What a session file holds.

    Parameters
    ----------
    meshes : tuple of Mesh
    now : int
        Which of them was shown.
    window : object
        Plain data with arrays, as `write_archive` takes it.
    version : int
        Of the file: fields that are newer are not in it.
    """

    meshes: tuple[Mesh, ...]
    now: int
    window: Any
    version: int = VERSION


def write_session(path: str | os.PathLike[str], meshes: Sequence[Mesh], now: int, window: Any) -> None:
    """Write a session; who calls it sees to it that a file is replaced as a whole.

    Parameters
    ----------
    path : path-like
    meshes : sequence of Mesh
        What they share is written once.
    now : int
        Which of them is shown.
    window : object
    """
    from hexmend.io.archive.archive import write_archive

    write_archive(path, _FORMAT, VERSION, _tree(meshes, now, window))


class SessionFolder:
    """A session that is written again and again as a folder, of which only what is new is written each time.

    The folder can be read at any moment, whenever who writes it is killed; see `hexmend.io.archive.folder`.

    Parameters
    ----------
    path : Path
        Of the folder.
    """

    def __init__(self, path: Path):
        from hexmend.io.archive.folder import ArchiveFolder

        self._folder = ArchiveFolder(path)

    def write(self, meshes: Sequence[Mesh], now: int, window: Any) -> None:
        """Write the session as it is now; parameters as of `write_session`.

        Raises
        ------
        FileError
            Where the folder cannot be written to; what was there stays.
        """
        self._folder.write(_FORMAT, VERSION, _tree(meshes, now, window))


def _tree(meshes: Sequence[Mesh], now: int, window: Any) -> dict[str, Any]:
    from hexmend.io.archive.mesh_data import mesh_to_data

    return {"meshes": [mesh_to_data(mesh) for mesh in meshes], "now": now, "window": window}


def read_session(path: str | os.PathLike[str]) -> SessionContent:
    """Read a session, from a file or from the folder of a `SessionFolder`.

    Raises
    ------
    FileError
        Where it is none, is damaged, or is of a newer version.
    """
    from hexmend.io.archive.mesh_data import MeshDecoder

    version, data = _data(path)
    try:
        make, now = MeshDecoder(version), _number(data)
        return SessionContent(tuple(make.mesh(one) for one in data["meshes"]), now, data["window"], version)
    except MeshError as error:
        raise _unfit(path, error) from None


def _read(path: Path) -> Mesh:
    """The mesh that was shown."""
    from hexmend.io.archive.mesh_data import MeshDecoder

    version, data = _data(path)
    try:
        return MeshDecoder(version).mesh(data["meshes"][_number(data)])
    except MeshError as error:
        raise _unfit(path, error) from None


def _data(path: str | os.PathLike[str]) -> tuple[int, Any]:
    """The version of a session and what is in it."""
    from hexmend.io.archive.archive import read_archive
    from hexmend.io.files import check_readable

    if not Path(path).is_dir():
        check_readable(Path(path), "a session")
    try:
        return read_archive(path, _FORMAT, VERSION)
    except OSError as error:
        raise FileError(path, f"cannot be read: {error.strerror or error}") from None


def _number(data: Any) -> int:
    """Which of its meshes a session shows, once it is known that it has the fields of one."""
    from hexmend.io.archive.mesh_data import check_fields

    check_fields("the session", data, {"meshes", "now", "window"})
    meshes, now = data["meshes"], data["now"]
    if not isinstance(meshes, list) or type(now) is not int or not 0 <= now < len(meshes):
        raise MeshError("it does not say which of its meshes was shown")
    if len(meshes) > MOST:
        raise MeshError(f"it has {len(meshes):,} meshes: expected {MOST:,} at most")
    return now


def _unfit(path: str | os.PathLike[str], error: MeshError) -> FileError:
    return FileError(path, str(error), "Use an earlier copy, or open the mesh that it was made from.")


def is_session(head: bytes) -> bool:
    """Whether a file that begins with these bytes is a session."""
    begin, name = _HEAD
    return head.startswith(begin) and head[30 : 30 + len(name)] == name


register(
    Format(
        name="session",
        title="Hexmend session",
        suffixes=(SUFFIX,),
        encodings=(),
        read=_read,
        matches=is_session,
    )
)

__getattr__ = exports(__name__)
