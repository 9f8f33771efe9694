"""Reading and writing by suffix and content: the one door through which every format is used."""

from __future__ import annotations

import difflib
import os
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import NoReturn

from hexmend.errors import FileError, MeshError
from hexmend.io.base.capabilities import required_capabilities
from hexmend.io.base.format import FORMATS, Format
from hexmend.io.base.missing_coordinates import INTERPOLATE_MISSING
from hexmend.io.base.plugins import plugin_formats
from hexmend.io.storage.atomic import atomic_write, check_writable
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.orientation import with_consistent_orientation


def read(path: str | os.PathLike[str], *, as_is: bool = False, nodes_without_place: bool = False) -> Mesh:
    """Read a hexahedral mesh.

    Parameters
    ----------
    path : path-like
        A file of one of the formats, which its content tells where its suffix does not.
    as_is : bool
        Keep parts whose hexes are all wound the other way as they are; else they are turned.
    nodes_without_place : bool
        Put nodes whose coordinates are no finite numbers between their neighbours; else they are an error.

    Returns
    -------
    Mesh
        Named after the file's stem. Node and hex order, data, sets, pins and other cells are kept. Its `notes`
        say what was done to it.

    Raises
    ------
    FileError
        For every reason why the file gives no mesh: it names the place in the file and what to do.
    """
    path = Path(path)
    check_readable(path, "a mesh file")
    format = _format_of(path)
    try:
        placing = INTERPOLATE_MISSING.set(nodes_without_place)
        try:
            mesh = format.read(path).replace(name=path.stem)
        finally:
            INTERPOLATE_MISSING.reset(placing)
        return mesh if as_is else with_consistent_orientation(mesh)
    except MeshError as error:
        raise FileError(path, str(error), _REMEDY["finite" in str(error)]) from None
    except MemoryError:
        raise FileError(
            path, "needs more memory than there is", "Close other programs or use a larger machine."
        ) from None
    except OSError as error:
        raise FileError(path, f"cannot be read: {error.strerror or error}") from None


def write(path: str | os.PathLike[str], mesh: Mesh, *, encoding: str | None = None) -> None:
    """Write a mesh as a whole or, where that fails, leave what was there.

    Parameters
    ----------
    path : path-like
        Its suffix chooses the format: one of `writable_suffixes()`.
    mesh : Mesh
    encoding : str, optional
        One of the format's `encodings`; the first of them if None.

    Raises
    ------
    FileError
        Where the place cannot be written to, or the format cannot hold the mesh.
    """
    path = Path(path)
    format = _writer(path)
    encoding = format.encodings[0] if encoding is None else encoding
    if encoding not in format.encodings:
        raise FileError(
            path, f"{format.title} has no encoding {encoding!r}", f"Use one of {', '.join(format.encodings)}."
        )
    with atomic_write(path) as temporary:
        try:
            format.write(temporary, mesh, encoding)
        except FileError as error:  # which names the temporary file
            raise FileError(path, error.problem, error.remedy) from None


def writer_for(path: str | os.PathLike[str]) -> Callable[[str | os.PathLike[str], Mesh], None]:
    """`write`, once it is known that the path's suffix can be written; so that a long run does not end in an error.

    Raises
    ------
    FileError
        For an unknown suffix, or a place that cannot be written to.
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
    """Suffixes of the files that `read` understands, with the dot."""
    return _suffixes(_every_format())


def writable_suffixes() -> tuple[str, ...]:
    """Suffixes of the files that `write` makes, with the dot."""
    return _suffixes(format for format in _every_format() if format.write)


def _every_format() -> tuple[Format, ...]:
    return *FORMATS.values(), *plugin_formats()


def _suffixes(formats: Iterable[Format]) -> tuple[str, ...]:
    return tuple(dict.fromkeys(suffix for format in formats for suffix in format.suffixes))


#: What to do about a mesh that is none, and about one of which coordinates are no numbers.
_REMEDY = {
    False: "Correct the file, or write it again with the program that made it.",
    True: "Correct the file, or let hexmend repair put such nodes between their neighbours.",
}

#: How much of a file is looked at to recognise its format.
_HEAD = 4096


def _format_of(path: Path) -> Format:
    """The format of a file: that of its suffix, unless the content is plainly that of another."""
    named = [format for format in FORMATS.values() if path.suffix.lower() in format.suffixes]
    with open(path, "rb") as file:
        head = file.read(_HEAD)
    for format in named:
        if format.matches is None or format.matches(head):
            return format
    for format in FORMATS.values():
        if format.matches is not None and format.matches(head):
            return format
    for format in plugin_formats():  # which are looked for only where none of these knows the file
        if format.matches is not None and format.matches(head):
            return format
        if not named and path.suffix.lower() in format.suffixes:
            return format
    return named[0] if named else _unknown(path, "read", _every_format())


def _writer(path: Path) -> Format:
    for formats in (FORMATS.values, plugin_formats):  # other distributions' are looked for where none of ours writes it
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
    """Raise a `FileError` where there is no regular file that may be read and holds something.

    Parameters
    ----------
    path : Path
    expected : str
        What the file should be, such as "a mesh file".
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
    except (OSError, ValueError) as error:  # a folder that may not be entered, a name that no file can have
        raise FileError(path, f"cannot be read: {getattr(error, 'strerror', None) or error}") from None
    if not os.access(path, os.R_OK):
        raise FileError(path, "cannot be read: permission denied", "Ask for permission to read it, or copy it.")


def _nearest(path: Path) -> str:
    """A hint at a file of a similar name, as a sentence."""
    try:
        near = difflib.get_close_matches(path.name, (one.name for one in path.absolute().parent.iterdir()), n=1)
    except OSError:
        near = []
    return f"Did you mean {near[0]}?" if near else "Check the spelling."
