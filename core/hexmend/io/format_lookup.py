"""Lookup of the format of a file, by its place, suffix and content, among ours and those of other distributions.

Files that no format reads, recognised by how they begin, and the way to a file that can be read.
"""

from __future__ import annotations

import os
import re
from codecs import BOM_UTF8
from collections.abc import Iterable, Iterator
from functools import cache
from itertools import count
from pathlib import Path
from typing import NoReturn

from hexmend.errors import FileError
from hexmend.io.base.format import FORMATS, Format
from hexmend.registry import load_entry_points

#: Entry-point group of the formats of other distributions; its entries name a `Format`.
_ENTRY_POINTS = "hexmend.formats"
#: Remedy for a mesh in a format of decks that are only copied with other coordinates.
OTHER_FORMAT = "Write .vtu, .inp or .k instead."
#: Bytes from which the format of a file is recognised.
_HEAD = 4096
#: First bytes of compressed files, by the program that compresses.
_COMPRESSIONS = {"gzip": b"\x1f\x8b", "bzip2": b"BZh", "xz": b"\xfd7zXZ\0", "zstd": b"\x28\xb5\x2f\xfd"}


@cache
def plugin_formats() -> tuple[Format, ...]:
    """Load the formats of other distributions, such as those that need VTK, once; a failure is logged as a warning."""
    found: list[Format] = []

    def take(name: str, format: object) -> None:
        if not isinstance(format, Format):
            raise TypeError(f"{format!r} is not a hexmend.io.Format")
        found.append(format)

    load_entry_points(_ENTRY_POINTS, "format", take)
    return tuple(found)


def every_format() -> tuple[Format, ...]:
    """Return all formats, those of plug-ins last."""
    return *FORMATS.values(), *plugin_formats()


def suffixes_of(formats: Iterable[Format]) -> tuple[str, ...]:
    """Return the suffixes of formats, each once."""
    return tuple(dict.fromkeys(suffix for format in formats for suffix in format.suffixes))


def format_by_place(path: Path) -> Format | None:
    """Find the format of a folder, or of a file that is part of one; None for other files."""
    try:
        return next((format for format in FORMATS.values() if format.place and format.place.contains(path)), None)
    except (OSError, ValueError):  # as of an invalid name, which is reported when it is read
        return None


def check_has_mesh(path: Path) -> None:
    """Raise `FileError` for a folder of some format that has no mesh yet."""
    for format in FORMATS.values():
        if format.place:
            format.place.check_has_mesh(path)


def format_of(path: Path) -> Format:
    """Find the format of a file: by its place or suffix, unless the content is of another format."""
    placed = format_by_place(path)
    if placed is not None:
        return placed
    named = [format for format in FORMATS.values() if path.suffix.lower() in format.suffixes]
    with open(path, "rb") as file:
        head = file.read(_HEAD).removeprefix(BOM_UTF8)
    compression = next((name for name, magic in _COMPRESSIONS.items() if head.startswith(magic)), "")
    check_not_foreign(path, head)
    for format in named:
        if format.matches(head) if format.matches is not None else not compression:
            return format
    for format in FORMATS.values():
        if format.matches is not None and format.matches(head):
            return format
    for format in plugin_formats():  # loaded only if none of ours matches
        if format.matches is not None and format.matches(head):
            return format
        if not named and path.suffix.lower() in format.suffixes:
            return format
    if compression:
        raise FileError(path, f"is compressed by {compression}", "Decompress it first.")
    return named[0] if named else _unknown(path, "read", every_format())


def unused_path(path: str | os.PathLike[str]) -> Path:
    """Return the path of a new file beside another one, for a result that cannot be written there.

    The name has a number where there is a file, folder or link of this name already.

    >>> unused_path("dir/part.inp").as_posix()
    'dir/part-hexmend.inp'
    """
    path = Path(path)
    placed = format_by_place(path)
    if placed is None:
        return next(one for end in _endings() if not os.path.lexists(one := path.with_stem(f"{path.stem}{end}")))
    case = path.parent if path.is_file() else path
    folder = next(one for end in _endings() if not os.path.lexists(one := case.with_name(f"{case.name}{end}")))
    return folder / f"mesh{placed.suffixes[0]}"


def _endings() -> Iterator[str]:
    """Iterate over endings of names: "-hexmend", "-hexmend-2" and so on."""
    return (f"-hexmend-{number}" if number > 1 else "-hexmend" for number in count(1))


def copy_suffix(path: str | os.PathLike[str]) -> str:
    """Return the suffix of a copy of a mesh: the file's own, or none for a mesh of several files."""
    return "" if format_by_place(Path(path)) else Path(path).suffix


def writable_format(path: Path, source: Path | None = None) -> Format:
    """Return the format that a file is written in.

    Parameters
    ----------
    path : Path
        Its place or suffix chooses the format.
    source : Path, optional
        File that the mesh was read from; a case is written as a case where the suffix chooses nothing.

    Raises
    ------
    FileError
        For an unknown suffix, and for a folder that is no case.
    """
    placed = format_by_place(path)
    if placed is not None and placed.write:
        return placed
    for formats in (FORMATS.values, plugin_formats):  # plug-ins are loaded only if none of ours writes it
        for format in formats():
            if format.write and path.suffix.lower() in format.suffixes:
                return format
    given = format_of(source) if source is not None and source.is_file() else None
    if given is not None and given.locate and path.suffix.lower() in given.suffixes:
        return given  # a copy with other coordinates
    if deck := next((one for one in FORMATS.values() if one.locate and path.suffix.lower() in one.suffixes), None):
        raise FileError(path, f"{deck.title} is written as a copy of a deck with other coordinates only", OTHER_FORMAT)
    copied = None if source is None else format_by_place(source)
    if copied is not None and copied.write:
        return copied
    if path.is_dir():
        example = path / (source.name if source is not None and source.suffix else "mesh.vtu")
        raise FileError(path, "is a folder: expected the name of a file to write", f"Name one, such as {example}.")
    return _unknown(path, "write", [format for format in every_format() if format.write])


def _unknown(path: Path, verb: str, formats: Iterable[Format]) -> NoReturn:
    titles = {suffix: format.title for format in reversed(tuple(formats)) for suffix in reversed(format.suffixes)}
    known = ", ".join(f"{suffix} ({title})" for suffix, title in reversed(titles.items()))
    problem = f"the suffix {path.suffix!r} is unknown" if path.suffix else "the name has no suffix"
    raise FileError(path, problem, f"Hexmend can {verb} {known}.")


#: How a file begins, what it is, and what to do.
_KINDS = (
    (rb"version https://git-lfs", "is a pointer of Git LFS, not the file itself", "Fetch it: git lfs pull."),
    (
        rb"MFEM (?:NC )?mesh|MFEM NURBS|MFEM INLINE",
        "is a mesh of MFEM",
        "Open it in MFEM's mesh-explorer and save it as VTK (key V).",
    ),
    (
        rb"\s*\(\s*(?:0|1|2|10|12|13|39|45)\s",
        "is a mesh of Fluent",
        "Convert it with OpenFOAM's fluent3DMeshToFoam, and open the case.",
    ),
    (rb"# Created by COMSOL", "is a mesh of COMSOL", "Export it from COMSOL as NASTRAN (.nas)."),
    (
        rb"(?:libMesh-|DEAL |LIBM |MESH )",
        "is a mesh of libMesh",
        "Convert it with libMesh: meshtool-opt -i MESH.xda -o MESH.e.",
    ),
)


def check_not_foreign(path: Path, head: bytes) -> None:
    """Raise `FileError` for a file of a kind that is known and not read; it says what it is, and what to do.

    Parameters
    ----------
    path : Path
    head : bytes
        First bytes of the file.
    """
    for pattern, kind, remedy in _KINDS:
        if re.match(pattern, head):
            raise FileError(path, kind, remedy)
