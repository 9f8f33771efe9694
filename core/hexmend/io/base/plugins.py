"""Formats of other distributions, such as those that need VTK, from the entry-point group `hexmend.formats`."""

from __future__ import annotations

from functools import cache

from hexmend.io.base.format import Format
from hexmend.registry import load_entry_points

#: Entry-point group whose entries name a `Format`.
GROUP = "hexmend.formats"


@cache
def plugin_formats() -> tuple[Format, ...]:
    """Load the formats of other distributions, once; a failure is logged as a warning."""
    found: list[Format] = []

    def take(name: str, format: object) -> None:
        if not isinstance(format, Format):
            raise TypeError(f"{format!r} is not a hexmend.io.Format")
        found.append(format)

    load_entry_points(GROUP, "format", take)
    return tuple(found)
