"""Task of a study: one case on one mesh, with the key of its result."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from hexmend.errors import FileError
from hexmend.io.files import check_readable
from hexmend.io.format_lookup import format_by_place
from hexmend.io.formats.vtk.pvtu import piece_paths


@dataclass(frozen=True)
class Task:
    """Case on one mesh, as data for another process or machine.

    Parameters
    ----------
    mesh : str
        Absolute path.
    mesh_hash : str
        SHA-256 of its content, `content_hash`.
    case : mapping
        `Case.values`.
    version : str
        Version of Hexmend.
    max_seconds : float
        0 for no limit.
    max_memory_mb : int
        0 for a share of the memory of the machine.
    surface, surface_hash : str
        Path and hash of the surface on which the boundary slides; "" if there is none.
    output : str
        Absolute path of the mesh to be written; "" for none.
    """

    mesh: str
    mesh_hash: str
    case: Mapping[str, Any]
    version: str
    max_seconds: float = 0.0
    max_memory_mb: int = 0
    surface: str = ""
    surface_hash: str = ""
    output: str = ""

    @property
    def key(self) -> str:
        """Hash, 32 hexadecimal digits, of all that the result depends on, which paths are not."""
        suffix = Path(self.mesh).suffix.lower()  # selects the format
        content = [self.version, self.mesh_hash, suffix, self.surface_hash, self.case]
        return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()[:32]


def content_hash(path: Path) -> str:
    """Return the SHA-256 of a file, in hexadecimal digits; of a PVTU file with its pieces, of a case its mesh.

    Parameters
    ----------
    path : Path

    Returns
    -------
    str

    Raises
    ------
    FileError
        If it cannot be read.
    """
    placed = format_by_place(path)
    if placed is None:
        check_readable(path, "a mesh file")
    try:
        if placed is not None:
            every = [_digest(part) for part in placed.place.parts(path)]
            return hashlib.sha256("".join(every).encode()).hexdigest()
        digest = _digest(path)
        if path.suffix.lower() == ".pvtu":
            every = [digest, *(_digest(piece) for piece in piece_paths(path) if piece.is_file())]
            digest = hashlib.sha256("".join(every).encode()).hexdigest()
    except OSError as error:
        raise FileError(path, f"cannot be read: {error.strerror or error}") from None
    return digest


def _digest(path: Path) -> str:
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()
