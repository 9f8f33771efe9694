"""Reading and writing of mesh files; the format follows from suffix and content."""

from __future__ import annotations

import difflib
import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path

from hexmend.aliases import old_keywords
from hexmend.errors import FileError, MeshError
from hexmend.io.base.capabilities import required_capabilities
from hexmend.io.base.missing_coordinates import INTERPOLATE_MISSING
from hexmend.io.format_choice import (
    every_format,
    format_by_content,
    format_by_place,
    format_to_write,
    has_format,
    suffixes_of,
)
from hexmend.io.storage.atomic import atomic_write, check_writable
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.orientation import with_consistent_orientation


@old_keywords("read")
def read(path: str | os.PathLike[str], *, as_is: bool = False, interpolate_missing: bool = False) -> Mesh:
    """Read a hexahedral mesh.

    Parameters
    ----------
    path : path-like
        A file of any format in `FORMATS`; the content decides where the suffix is unknown or misleading. For OpenFOAM
        also the folder of a case.
    as_is : bool
        Keep parts whose hexes are all mirrored; else their node order is reversed.
    interpolate_missing : bool
        Place nodes without finite coordinates between their neighbours; else they are an error.

    Returns
    -------
    Mesh
        Named after the file's stem or the case. The order of nodes and hexes, data, sets, fixed nodes and other cells
        are kept. Its `notes` list the changes made on reading.

    Raises
    ------
    FileError
        Where the file cannot be read as a mesh: it names the location in the file and a remedy.
    """
    path = Path(path)
    format = format_by_place(path)
    if format is None:
        check_readable(path, "a mesh file or the folder of an OpenFOAM case")
        format = format_by_content(path)
    token = INTERPOLATE_MISSING.set(interpolate_missing)
    try:
        with reading(path, "Close other programs or use a larger machine."):
            mesh = format.read(path)
            mesh = mesh if format.contains else mesh.replace(name=path.stem)
            return mesh if as_is else with_consistent_orientation(mesh)
    except MeshError as error:
        raise FileError(path, str(error), _REMEDY["finite" in str(error)]) from None
    finally:
        INTERPOLATE_MISSING.reset(token)


def write(
    path: str | os.PathLike[str],
    mesh: Mesh,
    *,
    encoding: str | None = None,
    source: str | os.PathLike[str] | None = None,
) -> None:
    """Write a mesh; if that fails, an earlier file stays unchanged.

    Parameters
    ----------
    path : path-like
        Its suffix chooses the format; one of `writable_suffixes()`.
    mesh : Mesh
        Data that the format cannot store are left out; see `unsupported_data`.
    encoding : str, optional
        One of the format's `encodings`; the first one if None.
    source : path-like, optional
        The file that the mesh was read from. If it has the same format, and the format allows it, only the points are
        replaced and everything else is kept: an OpenFOAM case is copied, or changed in place.

    Raises
    ------
    FileError
        For an unknown suffix or encoding, and where the file cannot be written.
    """
    path = Path(path)
    format = format_to_write(path, source)
    replace = format.replace_points if encoding is None and source is not None else None
    if replace and has_format(format, Path(source)) and replace(path, mesh, Path(source)):
        return
    encoding = format.encodings[0] if encoding is None else encoding
    if encoding not in format.encodings:
        problem = f"{format.title} has no encoding {encoding!r}"
        raise FileError(path, problem, f"Use one of {', '.join(format.encodings)}.")
    if format.contains:
        format.write(path, mesh, encoding)
        return
    with atomic_write(path) as temporary:
        try:
            format.write(temporary, mesh, encoding)
        except FileError as error:  # it names the temporary file
            raise FileError(path, error.problem, error.remedy) from None


def writer_for(
    path: str | os.PathLike[str], source: str | os.PathLike[str] | None = None
) -> Callable[[str | os.PathLike[str], Mesh], None]:
    """Return `write` after a check of suffix and folder, so that errors are found before a long run.

    Parameters
    ----------
    path : path-like
    source : path-like, optional
        As of `write`.

    Returns
    -------
    callable
        `write`, with the source.

    Raises
    ------
    FileError
        For an unknown suffix, and where the file cannot be written.
    """
    path = Path(path)
    format = format_to_write(path, source)
    if not format.contains:
        check_writable(path)
    return partial(write, source=source)


def unsupported_data(
    path: str | os.PathLike[str], mesh: Mesh, source: str | os.PathLike[str] | None = None
) -> list[str]:
    """Describe the data of a mesh that are lost if it is written to a file.

    Parameters
    ----------
    path : path-like
        Its suffix chooses the format; the file need not exist.
    mesh : Mesh
    source : path-like, optional
        As of `write`.

    Returns
    -------
    list of str
        Phrases for a message, such as "node sets (inlet)"; empty if the file holds everything.

    Raises
    ------
    FileError
        For an unknown suffix, and for a case that has another mesh.
    """
    path, source = Path(path), None if source is None else Path(source)
    format = format_to_write(path, source)
    if format.omissions and (lost := format.omissions(path, mesh, source)) is not None:
        return lost
    required = required_capabilities(mesh, format.stored_names)
    missing = [description for kind, description in required.items() if kind not in format.capabilities]
    return missing + (format.limitations(mesh) if format.limitations else [])


def copy_suffix(path: str | os.PathLike[str]) -> str:
    """Return the suffix that a copy of a mesh gets: that of the file, or none for a case, which is a folder."""
    return "" if format_by_place(Path(path)) else Path(path).suffix


def readable_suffixes() -> tuple[str, ...]:
    """Return the suffixes that `read` knows, with the dot."""
    return suffixes_of(every_format())


def writable_suffixes() -> tuple[str, ...]:
    """Return the suffixes that `write` knows, with the dot."""
    return suffixes_of(format for format in every_format() if format.write)


#: Remedies for an invalid mesh: False in general, True for coordinates that are not finite.
_REMEDY = {
    False: "Correct the file, or write it again with the program that made it.",
    True: "Correct the file, or let hexmend repair put such nodes between their neighbours.",
}


def check_readable(path: Path, expected: str) -> None:
    """Raise a `FileError` unless the path is a readable regular file that is not empty.

    Parameters
    ----------
    path : Path
    expected : str
        Expected content for errors, such as "a mesh file".
    """
    try:
        if path.is_dir():
            raise FileError(path, f"is a folder: expected {expected}", "Name a file in it.")
        if not path.exists():
            raise FileError(path, f"there is no such file in {path.absolute().parent}", _nearest(path))
        if not path.is_file():
            raise FileError(path, "is no regular file", "Save it to a file first.")
        if path.stat().st_size == 0:
            raise FileError(path, "is empty", "Write it again with the program that made it.")
    except (OSError, ValueError) as error:  # a folder without permission, an invalid name
        raise FileError(path, f"cannot be read: {getattr(error, 'strerror', None) or error}") from None
    if not os.access(path, os.R_OK):
        raise FileError(path, "cannot be read: permission denied", "Ask for permission to read it, or copy it.")


@contextmanager
def reading(path: Path, remedy: str) -> Iterator[None]:
    """Context manager that turns errors of the memory and the file system into a `FileError`.

    Parameters
    ----------
    path : Path
    remedy : str
        Advice where the memory does not suffice.
    """
    try:
        yield
    except MemoryError:
        raise FileError(path, "needs more memory than there is", remedy) from None
    except OSError as error:
        raise FileError(path, f"cannot be read: {error.strerror or error}") from None


def _nearest(path: Path) -> str:
    """Suggest a file of a similar name, as a sentence."""
    try:
        near = difflib.get_close_matches(path.name, (entry.name for entry in path.absolute().parent.iterdir()), n=1)
    except OSError:
        near = []
    return f"Did you mean {near[0]}?" if near else "Check the spelling."
