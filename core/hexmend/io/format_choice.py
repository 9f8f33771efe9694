"""The format of a file: by its place or content on reading, by its place or suffix on writing."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path
from typing import NoReturn

from hexmend.errors import FileError
from hexmend.io.base.format import FORMATS, Format
from hexmend.io.base.plugins import plugin_formats

#: Bytes from which the format of a file is recognised.
_HEAD = 4096


def format_by_place(path: Path) -> Format | None:
    """Find the format of a folder, or of a file that is part of one; None for other files."""
    try:
        return next((format for format in FORMATS.values() if format.contains and format.contains(path)), None)
    except (OSError, ValueError):  # as of an invalid name, which is reported when it is read
        return None


def has_format(format: Format, path: Path) -> bool:
    """Return True if a file that has been read has a format."""
    if format.contains:
        return format_by_place(path) is format
    return path.is_file() and format_by_content(path) is format


def format_by_content(path: Path) -> Format:
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
    return named[0] if named else _unknown(path, "read", every_format())


def format_to_write(path: Path, source: str | os.PathLike[str] | None = None) -> Format:
    """Find the format of a file to be written: by its place or suffix, for a new folder by that of the source."""
    placed = format_by_place(path)
    if placed is not None and placed.write:
        return placed
    for formats in (FORMATS.values, plugin_formats):  # plug-ins are loaded only if none of ours writes it
        for format in formats():
            if format.write and path.suffix.lower() in format.suffixes:
                return format
    copied = None if source is None else format_by_place(Path(source))
    if copied is not None and copied.write:
        return copied
    return _unknown(path, "write", [format for format in every_format() if format.write])


def _unknown(path: Path, verb: str, formats: Iterable[Format]) -> NoReturn:
    titles = {suffix: format.title for format in reversed(tuple(formats)) for suffix in reversed(format.suffixes)}
    known = ", ".join(f"{suffix} ({title})" for suffix, title in reversed(titles.items()))
    problem = f"the suffix {path.suffix!r} is unknown" if path.suffix else "the name has no suffix"
    raise FileError(path, problem, f"Hexmend can {verb} {known}.")


def every_format() -> tuple[Format, ...]:
    return *FORMATS.values(), *plugin_formats()


def suffixes_of(formats: Iterable[Format]) -> tuple[str, ...]:
    return tuple(dict.fromkeys(suffix for format in formats for suffix in format.suffixes))
