"""Meshes of the folder that the environment variable HEXMEND_MESHES names."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

from hexmend.errors import FileError, MeshError
from hexmend.io import read, readable_suffixes
from hexmend.mesh.mesh import Mesh


def mesh_files() -> list[Path]:
    """List the files with a suffix of a mesh; none without the variable."""
    folder = os.environ.get("HEXMEND_MESHES")
    return [path for path in sorted(Path(folder).iterdir()) if path.suffix in readable_suffixes()] if folder else []


def collection() -> Iterator[tuple[Path, Mesh]]:
    """Yield the files that can be read, with their meshes."""
    for path in mesh_files():
        with suppress(FileError, MeshError):
            yield path, read(path)
