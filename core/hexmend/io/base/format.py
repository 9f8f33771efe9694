"""What a file format is, what it can hold, and the registry in which formats announce themselves."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum
from pathlib import Path

from hexmend.aliases import exports
from hexmend.mesh.mesh import Mesh
from hexmend.registry import Registry


class Capability(Enum):
    """Something that comes with a mesh, in words; whether a mesh has it is asked by `found_in`."""

    NODE_DATA = "point data"
    HEX_DATA = "cell data"
    IDS = "ids of nodes and elements"
    NODE_SETS = "node sets"
    HEX_SETS = "element sets"
    CELL_SETS = "sets of cells of lower dimension"
    SIDE_SETS = "side sets"
    EMPTY_SETS = "sets without members"
    PINS = "fixed nodes"
    LOWER_CELLS = "cells of lower dimension"
    VERTICES = "vertices as cells"
    OTHER_CELLS = "tetrahedra, pyramids and wedges"
    SECOND_ORDER = "nodes of second order"
    FIELD_DATA = "field data"


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
        How its numbers can be written ("binary", "ascii", ...); the first is the default. Empty where it is read only.
    read : callable
        From path to Mesh; raises FileError or MeshError, and OSError where the file system fails.
    write : callable, optional
        From path, mesh and an encoding to nothing; opens the path itself.
    holds : frozenset of Capability
        What is written, and read again as it was; all else is left out, which `left_out` says.
    names : frozenset of str
        Data and sets that are held by their names, though others are not.
    cannot : callable, optional
        From mesh to what the format cannot hold of what it holds as a rule, in words; `left_out` adds them.
    exact : bool
        Whether coordinates are written with all their digits.
    recognised : callable, optional
        Whether a file that begins with these bytes (some 4,096, or all) is of this format, whatever its suffix.
    """

    name: str
    title: str
    suffixes: tuple[str, ...]
    encodings: tuple[str, ...]
    read: Callable[[Path], Mesh]
    write: Callable[[Path, Mesh, str], None] | None = None
    holds: frozenset[Capability] = frozenset()
    names: frozenset[str] = frozenset()
    recognised: Callable[[bytes], bool] | None = None
    exact: bool = True
    cannot: Callable[[Mesh], list[str]] | None = None


#: Every format by name.
FORMATS: Registry[Format] = Registry("format")

__getattr__ = exports(__name__)
