"""What a file format is, and the registry in which formats announce themselves."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from hexmend.mesh import Mesh
from hexmend.registry import Registry


@dataclass(frozen=True)
class Format:
    """A file format, as its module declares it.

    Parameters
    ----------
    name : str
        The key in FORMATS.
    title : str
        What people call it.
    suffixes : tuple of str
        Lower case, with the dot.
    encodings : tuple of str
        How its numbers can be written ("binary", "ascii", ...); the first is the default.
    read : callable
        From path to Mesh; raises FileError or MeshError, and OSError where the file system fails.
    write : callable
        From path, mesh and an encoding to nothing; opens the path itself.
    holds_hex_sets : bool
        Whether named groups of hexes are written; where not, they are left out.
    """

    name: str
    title: str
    suffixes: tuple[str, ...]
    encodings: tuple[str, ...]
    read: Callable[[Path], Mesh]
    write: Callable[[Path, Mesh, str], None]
    holds_hex_sets: bool = True


#: Every format by name.
FORMATS: Registry[Format] = Registry("format")
