"""Reading and writing of mesh files; the format follows from suffix and content."""

from __future__ import annotations

import difflib
import os
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import NoReturn

from hexmend.aliases import old_keywords
from hexmend.errors import FileError, MeshError
from hexmend.io.base.capabilities import required_capabilities
from hexmend.io.base.format import FORMATS, Format
from hexmend.io.base.missing_coordinates import INTERPOLATE_MISSING
from hexmend.io.base.plugins import plugin_formats
from hexmend.io.storage.atomic import atomic_write, check_writable
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.orientation import with_consistent_orientation


@old_keywords("read")
def read(path: str | os.PathLike[str], *, as_is: bool = False, interpolate_missing: bool = False) -> Mesh:
    """Read a hexahedral mesh.

    Parameters
    ----------
    path : path-like
        A file of any format in `FORMATS`; the content decides where the suffix is unknown or misleading.
    as_is : bool
        Keep parts whose hexes are all mirrored; else their node order is reversed.
    interpolate_missing : bool
        Place nodes without finite coordinates between their neighbours; else they are an error.

    Returns
    -------
    Mesh
        Named after the file's stem. The order of nodes and hexes, data, sets, fixed nodes and other cells are kept.
        Its `notes` list the changes made on reading.

    Raises
    ------
    FileError
        Where the file cannot be read as a mesh: it names the location in the file and a remedy.
    """
    path = Path(path)
    check_readable(path, "a mesh file")
    format = _format_of(path)
    token = INTERPOLATE_MISSING.set(interpolate_missing)
    try:
        with reading(path, "Close other programs or use a larger machine."):
            mesh = format.read(path).replace(name=path.stem)
            return mesh if as_is else with_consistent_orientation(mesh)
    except MeshError as error:
        raise FileError(path, str(error), _REMEDY["finite" in str(error)]) from None
    finally:
        INTERPOLATE_MISSING.reset(token)


def write(path: str | os.PathLike[str], mesh: Mesh, *, encoding: str | None = None) -> None:
    """Write a mesh; if that fails, an earlier file stays unchanged.

    Parameters
    ----------
    path : path-like
        Its suffix chooses the format; one of `writable_suffixes()`.
    mesh : Mesh
        Data that the format cannot store are left out; see `unsupported_data`.
    encoding : str, optional
        One of the format's `encodings`; the first one if None.

    Raises
    ------
    FileError
        For an unknown suffix or encoding, and where the file cannot be written.
    """
    path = Path(path)
    format = _writer(path)
    encoding = format.encodings[0] if encoding is None else encoding
    if encoding not in format.encodings:
        problem = f"{format.title} has no encoding {encoding!r}"
        raise FileError(path, problem, f"Use one of {', '.join(format.encodings)}.")
    with atomic_write(path) as temporary:
        try:
            format.write(temporary, mesh, encoding)
        except FileError as error:  # it names the temporary file
            raise FileError(path, error.problem, error.remedy) from None


def writer_for(path: str | os.PathLike[str]) -> Callable[[str | os.PathLike[str], Mesh], None]:
    """Return `write` after a check of suffix and folder, so that errors are found before a long run.

    Parameters
    ----------
    path : path-like

    Returns
    -------
    callable
        `write`

    Raises
    ------
    FileError
        For an unknown suffix, and where the file cannot be written.
    """
    path = Path(path)
    _writer(path)
    check_writable(path)
    return write


def unsupported_data(path: str | os.PathLike[str], mesh: Mesh) -> list[str]:
    """Describe the data of a mesh that are lost if it is written to a file.

    Parameters
    ----------
    path : path-like
        Its suffix chooses the format; the file need not exist.
    mesh : Mesh

    Returns
    -------
    list of str
        Phrases for a message, such as "node sets (inlet)"; empty if the file holds everything.

    Raises
    ------
    FileError
        For an unknown suffix.
    """
    format = _writer(Path(path))
    required = required_capabilities(mesh, format.stored_names)
    missing = [description for kind, description in required.items() if kind not in format.capabilities]
    return missing + (format.limitations(mesh) if format.limitations else [])


def readable_suffixes() -> tuple[str, ...]:
    """Return the suffixes that `read` knows, with the dot."""
    return _suffixes(_every_format())


def writable_suffixes() -> tuple[str, ...]:
    """Return the suffixes that `write` knows, with the dot."""
    return _suffixes(format for format in _every_format() if format.write)


def _every_format() -> tuple[Format, ...]:
    return *FORMATS.values(), *plugin_formats()


def _suffixes(formats: Iterable[Format]) -> tuple[str, ...]:
    return tuple(dict.fromkeys(suffix for format in formats for suffix in format.suffixes))


#: Remedies for an invalid mesh: False in general, True for coordinates that are not finite.
_REMEDY = {
    False: "Correct the file, or write it again with the program that made it.",
    True: "Correct the file, or let hexmend repair put such nodes between their neighbours.",
}

#: Bytes from which the format of a file is recognised.
_HEAD = 4096


def _format_of(path: Path) -> Format:
    """Find the format of a file: by the suffix, unless the content is of another format."""
    named = [format for format in FORMATS.values() if path.suffix.lower() in format.suffixes]
    with open(path, "rb") as file:
        head = file.read(_HEAD)
    for format in named:
        if format.matches is None or format.matches(head):
            return format
    for format in FORMATS.values():
        if format.matches is not None and format.matches(head):
            return format
    for format in plugin_formats():  # loaded only if none of ours matches
        if format.matches is not None and format.matches(head):
            return format
        if not named and path.suffix.lower() in format.suffixes:
            return format
    return named[0] if named else _unknown(path, "read", _every_format())


def _writer(path: Path) -> Format:
    for formats in (FORMATS.values, plugin_formats):  # plug-ins are loaded only if none of ours writes it
        for format in formats():
            if format.write and path.suffix.lower() in format.suffixes:
                return format
    return _unknown(path, "write", [format for format in _every_format() if format.write])


def _unknown(path: Path, verb: str, formats: Iterable[Format]) -> NoReturn:
    titles = {suffix: format.title for format in reversed(tuple(formats)) for suffix in reversed(format.suffixes)}
    known = ", ".join(f"{suffix} ({title})" for suffix, title in reversed(titles.items()))
    problem = f"the suffix {path.suffix!r} is unknown" if path.suffix else "the name has no suffix"
    raise FileError(path, problem, f"Hexmend can {verb} {known}.")


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
