"""File formats, the mesh data that they can store, and the registry of all formats."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum
from importlib import import_module
from pathlib import Path
from typing import Any

from hexmend.aliases import exports, reads_old_members, reads_old_names
from hexmend.mesh.mesh import Mesh
from hexmend.registry import Registry


@reads_old_members
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


@reads_old_names
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
    contains : callable, optional
        For formats of several files: contains(path) returns True if a folder, or a file whatever its content is, is
        of the format. `write` then gets the path that was named and replaces files itself.
    replace_points : callable, optional
        replace_points(path, mesh, source) writes the file that the mesh was read from with other points and everything
        else as it is; returns False, without writing, if the mesh is no longer that of the file.
    omissions : callable, optional
        omissions(path, mesh, source) describes what is lost where the points alone are replaced, list of str; None
        where it follows from the capabilities. It raises `FileError` where the path cannot be written.
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
    contains: Callable[[Path], bool] | None = None
    replace_points: Callable[[Path, Mesh, Path], bool] | None = None
    omissions: Callable[[Path, Mesh, Path | None], list[str] | None] | None = None


#: All formats of Hexmend by name; those of other distributions are in `hexmend.io.base.plugins`.
FORMATS: Registry[Format] = Registry("format")


def deferred(function: str) -> Callable[..., Any]:
    """Return a function that imports another one, "module:function", when it is called: for a quick start."""
    module, _, name = function.partition(":")
    return lambda *arguments: getattr(import_module(module), name)(*arguments)


def register(*fields: Any, **named_fields: Any) -> Format:
    """Make a `Format` of its fields and add it to FORMATS."""
    format = Format(*fields, **named_fields)
    return FORMATS.add(format.name, format)


__getattr__ = exports(__name__)
