"""Nastran's bulk data (.bdf, .nas, .dat): grid points and elements, whose properties are sets.

*NX Nastran Quick Reference Guide*, "Bulk Data Entries": small fields of 8 columns, large fields of 16 columns, and free
fields between commas; GRID, CHEXA, CTETRA, CPENTA, CPYRAM, CQUAD*, CTRIA* and one-dimensional elements.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

from hexmend.io.base.format import Capability, Format, register
from hexmend.io.formats.nastran.cards import PROPERTY_SET
from hexmend.mesh.mesh import Mesh


def read(path: Path) -> Mesh:
    """Read grid points and elements; the elements of property N become the set "property N"."""
    from hexmend.io.formats.nastran import reader

    return reader.read(path)


def write(path: Path, mesh: Mesh, encoding: str) -> None:
    """Write grid points and elements; the elements of a set "property N" get property N, others an unused one."""
    from hexmend.io.formats.nastran import writer

    writer.write(path, mesh)


def _limitations(mesh: Mesh) -> list[str]:
    """List the data of a mesh that a file cannot hold, in words."""
    from hexmend.io.formats.nastran import writer

    return writer.limitations(mesh)


class _Properties(frozenset):
    """Names of sets that a file keeps: those of properties."""

    def __contains__(self, name: object) -> bool:
        return isinstance(name, str) and PROPERTY_SET.match(name) is not None


#: First statement of a file, after comments and blank lines.
_FIRST: Callable[[bytes], re.Match[bytes] | None] = re.compile(
    rb"(?:[ \t]*(?:\$[^\n]*)?\r?\n)*[ \t]*"
    rb"(?:BEGIN[ \t,]*BULK|SOL[ \t]+[0-9A-Z]|CEND|NASTRAN[ \t]|ID[ \t]|GRID\*?[ \t,]+[0-9]|CHEXA\*?[ \t,]+[0-9])",
    re.IGNORECASE,
).match


def _matches(head: bytes) -> bool:
    """Return True if a file begins with a statement of Nastran's executive control or bulk data."""
    return _FIRST(head) is not None


register(
    Format(
        name="nastran",
        title="Nastran",
        suffixes=(".bdf", ".nas", ".dat"),
        encodings=("ascii",),
        read=read,
        write=write,
        capabilities=frozenset(
            {
                Capability.IDS,
                Capability.OTHER_CELLS,
            }
        ),
        stored_names=_Properties(),
        limitations=_limitations,
        exact=False,  # a column has room for 12 to 14 digits
        matches=_matches,
    )
)
