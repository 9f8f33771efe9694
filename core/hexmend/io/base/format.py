"""File formats, the mesh data that they can store, and the registry of all formats."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum
from importlib import import_module
from pathlib import Path
from typing import Any, Protocol

from hexmend.io.coordinates.located import LocatedCoordinates
from hexmend.mesh.mesh import Mesh
from hexmend.registry import Registry


class Capability(Enum):
    """Kind of mesh data that a format may be able to store; the value names it in messages."""

    NODE_DATA = "point data"
    HEX_DATA = "cell data"
    IDS = "ids of nodes and elements"
    NODE_SETS = "node sets"
    HEX_SETS = "element sets"
    CELL_SETS = "sets of cells of lower dimension"
    SIDE_SETS = "side sets"
    EMPTY_SETS = "sets without members"
    FIXED_NODES = "fixed nodes"
    LOWER_CELLS = "cells of lower dimension"
    VERTICES = "vertices as cells"
    OTHER_CELLS = "tetrahedra, pyramids and wedges"
    SECOND_ORDER = "nodes of second order"
    FIELD_DATA = "field data"


class FolderPlace(Protocol):
    """Folders and files in them that are of a format whose meshes have several files."""

    def contains(self, path: Path) -> bool:
        """Return True if a path is of the format, whatever the content of a file is."""

    def check_has_mesh(self, path: Path) -> None:
        """Raise `FileError` for a folder of the format that has no mesh yet; it says how to make one."""

    def parts(self, path: Path) -> list[Path]:
        """Return the files that a mesh is read from."""

    def is_same(self, a: Path, b: Path) -> bool:
        """Return True if two paths lead to one existing mesh."""

    def check_target(self, path: Path, mesh: Mesh, source: Path | None) -> None:
        """Raise `FileError` where a path cannot take a mesh, which was read from `source` if that is not None."""


@dataclass(frozen=True)
class Format:
    """File format: names, functions that read and write it, and the mesh data that it stores.

    Parameters
    ----------
    name : str
        Key in FORMATS.
    title : str
        Name in messages and documentation.
    suffixes : tuple of str
        Lower case, with the dot.
    encodings : tuple of str
        Encodings of numbers that can be written ("binary", "ascii"); the first is the default. Empty if read-only.
    read : callable
        read(path) returns a Mesh; raises FileError or MeshError, and OSError where the file system fails.
    write : callable, optional
        write(path, mesh, encoding) creates the file.
    capabilities : frozenset of Capability
        Mesh data that survive writing and reading; `hexmend.io.unsupported_data` lists the others.
    stored_names : frozenset of str
        Names of data and sets that are stored although their kind is not among the capabilities.
    matches : callable, optional
        matches(head) returns True if a file that begins with these bytes (up to 4,096) has the format.
    exact : bool
        False if coordinates are rounded.
    limitations : callable, optional
        limitations(mesh) describes data of the mesh that are lost although the format has the capability, list of str.
    locate : callable, optional
        locate(path) finds the coordinates of a file, so that they can be replaced in a copy of it; returns
        `hexmend.io.coordinates.located.LocatedCoordinates`.
    included : callable, optional
        included(path) returns the paths of the files that a file includes, set of Path, with links resolved; empty for
        a file that is missing or cannot be read.
    place : FolderPlace, optional
        For formats of several files. `write` and the located coordinates then get the path that was named, and replace
        files themselves.
    """

    name: str
    title: str
    suffixes: tuple[str, ...]
    encodings: tuple[str, ...]
    read: Callable[[Path], Mesh]
    write: Callable[[Path, Mesh, str], None] | None = None
    capabilities: frozenset[Capability] = frozenset()
    stored_names: frozenset[str] = frozenset()
    matches: Callable[[bytes], bool] | None = None
    exact: bool = True
    limitations: Callable[[Mesh], list[str]] | None = None
    locate: Callable[[Path], LocatedCoordinates] | None = None
    included: Callable[[Path], set[Path]] | None = None
    place: FolderPlace | None = None
    remove: Callable[[Path], None] | None = None


FORMATS: Registry[Format] = Registry("format")
"""Formats of Hexmend by name; those of other distributions are in `hexmend.io.format_lookup`."""


def deferred(function: str) -> Callable[..., Any]:
    """Return a function that imports another one, "module:function", when it is called: for a quick start."""
    module, _, name = function.partition(":")
    return lambda *arguments: getattr(import_module(module), name)(*arguments)


def register(*fields: Any, **named_fields: Any) -> Format:
    """Make a `Format` of its fields and add it to FORMATS."""
    format = Format(*fields, **named_fields)
    return FORMATS.add(format.name, format)
