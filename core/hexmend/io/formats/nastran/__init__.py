"""Nastran's bulk data (.bdf, .nas, .dat; .fem of OptiStruct): grid points and elements, whose properties are sets.

*NX Nastran Quick Reference Guide*, "Bulk Data Entries": small fields of 8 columns, large fields of 16 columns, and free
fields between commas; GRID, CHEXA, CTETRA, CPENTA, CPYRAM, CQUAD*, CTRIA* and one-dimensional elements.
"""

from __future__ import annotations

import re

from hexmend.io.base.format import Capability, deferred, register
from hexmend.io.formats.nastran.cards import PROPERTY_SET


class _Properties(frozenset):
    """Names of sets that a file keeps: those of properties."""

    def __contains__(self, name: object) -> bool:
        return isinstance(name, str) and PROPERTY_SET.match(name) is not None


#: First statement of a file, after comments and blank lines.
_FIRST = re.compile(
    rb"(?:[ \t]*(?:\$[^\n]*)?\r?\n)*[ \t]*"
    rb"(?:BEGIN[ \t,]*BULK|SOL[ \t]+[0-9A-Z]|CEND|NASTRAN[ \t]|ID[ \t]|GRID\*?[ \t,]+[0-9]|CHEXA\*?[ \t,]+[0-9])",
    re.IGNORECASE,
)
_BEGIN = re.compile(rb"^BEGIN[ \t,]+BULK", re.IGNORECASE | re.MULTILINE)


register(
    name="nastran",
    title="Nastran",
    suffixes=(".bdf", ".nas", ".dat", ".fem"),
    encodings=("ascii",),
    read=deferred("hexmend.io.formats.nastran.reader:read"),
    write=deferred("hexmend.io.formats.nastran.cards:write"),
    capabilities=frozenset({Capability.IDS, Capability.OTHER_CELLS}),
    stored_names=_Properties(),
    limitations=deferred("hexmend.io.formats.nastran.cards:limitations"),
    exact=False,  # a column has room for 12 to 14 digits
    matches=lambda head: _FIRST.match(head) is not None or _BEGIN.search(head) is not None,
    locate=deferred("hexmend.io.formats.nastran.coordinates:locate"),
    included=deferred("hexmend.io.formats.nastran.bulk:included_files_of"),
)
