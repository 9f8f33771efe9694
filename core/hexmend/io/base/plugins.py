"""Formats of other distributions, such as those that need VTK, by the entry-point group `hexmend.formats`."""

from __future__ import annotations

from functools import cache

from hexmend.io.base.format import Format
from hexmend.registry import load_entry_points

#: Entries name a `Format`.
GROUP = "hexmend.formats"


@cache
def plugin_formats() -> tuple[Format, ...]:
    """Those formats, looked for once; one that cannot be loaded is told of, and the others go on."""
    found: list[Format] = []

    def take(name: str, format: object) -> None:
        if not isinstance(format, Format):
            raise TypeError(f"{format!r} is no hexmend.io.Format")
        found.append(format)

    load_entry_points(GROUP, "format", take)
    return tuple(found)
