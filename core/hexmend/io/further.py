"""Formats of other distributions, such as those that need VTK, by the entry-point group `hexmend.formats`."""

from __future__ import annotations

import logging
from functools import cache

from hexmend.io.format import Format

log = logging.getLogger(__name__)

#: Entries name a `Format`.
GROUP = "hexmend.formats"


@cache
def further() -> tuple[Format, ...]:
    """Those formats, looked for once; one that cannot be loaded is told of, and the others go on."""
    from importlib.metadata import entry_points  # which reads what is said of every distribution there is

    found = []
    for entry in sorted(entry_points(group=GROUP), key=lambda entry: entry.name):
        try:
            format = entry.load()
            if isinstance(format, Format):
                found.append(format)
        except (Exception, SystemExit) as error:  # whatever is wrong with it, the rest of the program is not to blame
            said = " ".join(f"{type(error).__name__}: {error}".split())
            log.warning("hexmend: the format %s is left out: %s", entry.name, said)
    return tuple(found)
