"""Lookup of the format of a file, by its suffix and content."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import NoReturn

from hexmend.errors import FileError
from hexmend.io.base.format import FORMATS, Format
from hexmend.io.base.plugins import plugin_formats

#: Bytes from which the format of a file is recognised.
_HEAD = 4096


def every_format() -> tuple[Format, ...]:
    """Return all formats, those of plug-ins last."""
    return *FORMATS.values(), *plugin_formats()


def suffixes_of(formats: Iterable[Format]) -> tuple[str, ...]:
    """Return the suffixes of formats, each once."""
    return tuple(dict.fromkeys(suffix for format in formats for suffix in format.suffixes))


def format_of(path: Path) -> Format:
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


def writable_format(path: Path) -> Format:
    """Return the format that a file is written in, by its suffix; `FileError` for an unknown one."""
    for formats in (FORMATS.values, plugin_formats):  # plug-ins are loaded only if none of ours writes it
        for format in formats():
            if format.write and path.suffix.lower() in format.suffixes:
                return format
    return _unknown(path, "write", [format for format in every_format() if format.write])


def _unknown(path: Path, verb: str, formats: Iterable[Format]) -> NoReturn:
    titles = {suffix: format.title for format in reversed(tuple(formats)) for suffix in reversed(format.suffixes)}
    known = ", ".join(f"{suffix} ({title})" for suffix, title in reversed(titles.items()))
    problem = f"the suffix {path.suffix!r} is unknown" if path.suffix else "the name has no suffix"
    raise FileError(path, problem, f"Hexmend can {verb} {known}.")
