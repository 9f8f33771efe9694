"""Replacement of coordinates in a copy of a mesh's file, in the same format.

Original file of a mesh, and its differences from a changed mesh other than the positions of nodes.
"""

from __future__ import annotations

import logging
import os
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.format import Capability, Format
from hexmend.io.coordinates.located import CoordinatesError, LocatedCoordinates
from hexmend.io.storage.atomic import atomic_files
from hexmend.mesh.cells import Cells
from hexmend.mesh.mesh import Mesh


@dataclass(frozen=True, eq=False)
class Original:
    """File of a mesh and the mesh that was read from it.

    Parameters
    ----------
    path : Path
    mesh : Mesh
        As it was read; changes of the file since then are recognised by its coordinates.
    """

    path: Path
    mesh: Mesh


def difference(given: Mesh, mesh: Mesh, capabilities: Collection[Capability] = frozenset(Capability)) -> str:
    """Describe the first difference of two meshes other than coordinates, notes and names; empty for none.

    Parameters
    ----------
    given, mesh : Mesh
    capabilities : collection of Capability
        Of the file's format: data that it cannot hold are not compared.

    Examples
    --------
    >>> from hexmend.mesh.hexahedron import UNIT_CUBE
    >>> mesh = Mesh(UNIT_CUBE, [[0, 1, 2, 3, 4, 5, 6, 7]])
    >>> difference(mesh, mesh.with_points(2 * UNIT_CUBE))
    ''
    >>> difference(mesh, mesh.replace(pinned=[True] * 8))
    'other fixed nodes'
    """
    always = {
        "nodes": (given.n_nodes, mesh.n_nodes),
        "hexes": (given.hexes, mesh.hexes),
        "nodes of second order": (given.mid_nodes, mesh.mid_nodes),
        "cells of other kinds": (given.cells, mesh.cells),
    }
    kept = {
        Capability.FIXED_NODES: (_marks(given), _marks(mesh)),
        Capability.NODE_DATA: (given.node_data, mesh.node_data),
        Capability.HEX_DATA: (given.hex_data, mesh.hex_data),
        Capability.NODE_SETS: (given.node_sets, mesh.node_sets),
        Capability.HEX_SETS: (given.hex_sets, mesh.hex_sets),
        Capability.SIDE_SETS: (given.side_sets, mesh.side_sets),
        Capability.FIELD_DATA: (given.field_data, mesh.field_data),
    }
    pairs = always | {kind.value: pair for kind, pair in kept.items() if kind in capabilities}
    return next((f"other {words}" for words, (before, after) in pairs.items() if not _equal(before, after)), "")


def _marks(mesh: Mesh) -> np.ndarray | None:
    return mesh.pinned if mesh.pinned is not None and mesh.pinned.any() else None


def _equal(a: object, b: object) -> bool:
    """Return True for values that are the same or hold the same."""
    if a is b:
        return True
    if isinstance(a, Cells) and isinstance(b, Cells):
        return _equal((a.kind, a.nodes, a.data, a.sets), (b.kind, b.nodes, b.data, b.sets))
    if isinstance(a, Mapping) and isinstance(b, Mapping):
        return list(a) == list(b) and all(_equal(a[name], b[name]) for name in a)
    if isinstance(a, list | tuple) and isinstance(b, list | tuple):
        return len(a) == len(b) and all(map(_equal, a, b))
    if isinstance(a, np.ndarray) and isinstance(b, np.ndarray):
        if a.shape != b.shape or a.dtype != b.dtype:
            return False
        return a.tobytes() == b.tobytes() if a.dtype.kind != "O" else a.tolist() == b.tolist()
    return type(a) is type(b) and a == b


_LOGGER = logging.getLogger(__name__)
#: Remedy for a file that is not overwritten.
REWRITE = "Choose another name, or rewrite the file (--rewrite)."
_TURNED = "Only coordinates were replaced: the hexes are numbered inside out in the written file, as in the given one."
#: Differences of coordinates, relative to the largest, that count as rounding: of a file that keeps seven digits.
_ROUNDING = 1e-6


class ChangedFileError(FileError):
    """File whose nodes are not those that were read from it."""


class IncludedFileError(FileError):
    """File that is not written because the deck of the mesh, or the copy of it, includes it."""


class LostContentError(FileError):
    """File that is not replaced by a new one, since it has content that the new one would not have."""


@dataclass(frozen=True)
class Written:
    """Way in which a mesh was written.

    Parameters
    ----------
    replaced : bool
        True if coordinates were replaced in a copy of the original file; False for a file written anew.
    notes : tuple of str
        Sentences for the user: why the file was written anew although the original has its format, or a loss of digits.
    in_place : bool
        True if the original file itself was changed.
    """

    replaced: bool
    notes: tuple[str, ...] = ()
    in_place: bool = False


def replace_coordinates(path: Path, mesh: Mesh, original: Original, format: Format) -> Written:
    """Write the original file with the coordinates of a mesh; all else in it stays, byte for byte where possible.

    Parameters
    ----------
    path : Path
        File to write; may be the original.
    mesh : Mesh
        Differs from the original's in the positions of its nodes alone.
    original : Original
    format : Format
        Of the original file.

    Returns
    -------
    Written

    Raises
    ------
    ChangedFileError
        If the original file has other nodes than the original mesh.
    IncludedFileError
        If the copy would include itself.
    CoordinatesError
        If the file cannot hold the mesh in this way.
    FileError
        If a file cannot be read or written.
    """
    different = difference(original.mesh, mesh, format.capabilities)
    if different:
        raise CoordinatesError(f"the mesh has {different} than {original.path.name}")
    if original.mesh.renumbered == "hexes":
        raise CoordinatesError(f"some hexes of {original.path.name} are numbered inside out")
    located = _located(original, format)
    is_same = format.place.is_same if format.place else is_same_file
    in_place = is_same(path, original.path)
    turned = (_TURNED,) if original.mesh.renumbered else ()
    with atomic_files() as files:
        notes = located.write(files, path, mesh.points)
    return Written(True, (*notes, *turned), in_place)


def _located(original: Original, format: Format) -> LocatedCoordinates:
    """Find the coordinates of the original file, after a check that they are those of its mesh."""
    path, given = original.path, original.mesh.points
    changed = ChangedFileError(path, "has changed since it was read", REWRITE)
    try:
        located = format.locate(path)
    except FileError:
        raise changed from None
    except (OSError, ValueError, LookupError) as error:
        _LOGGER.debug("the coordinates of %s were not found", path, exc_info=True)
        reason = error.strerror if isinstance(error, OSError) and error.strerror else "it has changed since"
        raise ChangedFileError(path, f"cannot be read again ({reason})", REWRITE) from None
    points = located.points
    if points.shape != given.shape:
        raise changed
    different = (points != given) & np.isfinite(points).all(axis=1)[:, None]  # others were put between neighbours
    if (np.abs(points[different] - given[different]) > _ROUNDING * np.abs(given).max()).any():
        raise changed
    return located


def is_same_file(a: str | os.PathLike[str], b: str | os.PathLike[str]) -> bool:
    """Return True if two paths lead to one existing file."""
    try:
        return os.path.samefile(a, b)
    except OSError:
        return False
