"""Input files of Abaqus and CalculiX (.inp): nodes, elements, sets and surfaces.

*Abaqus Keywords Guide*: *NODE, *ELEMENT, *NSET, *ELSET, *SURFACE, *PART and *INSTANCE; data of other keywords are left
out.
"""

from __future__ import annotations

import re

from hexmend.io.base.format import Capability, deferred, register

_LOST = {Capability.NODE_DATA, Capability.HEX_DATA, Capability.FIELD_DATA}
_FIRST_KEYWORDS = (b"HEADING", b"NODE", b"PART", b"PREPRINT", b"ELEMENT", b"ASSEMBLY", b"INCLUDE", b"PARAMETER")


def _matches(head: bytes) -> bool:
    """Return True if the first keyword, after comments and blank lines, can begin an input file."""
    found = re.search(rb"^[ \t]*\*(?!\*)[ \t]*([A-Za-z ]+)", head, re.MULTILINE)
    before = head[: found.start()].split(b"\n") if found else []
    comments = all(line.strip().startswith(b"**") or not line.strip() for line in before)
    return found is not None and comments and found[1].strip().upper() in _FIRST_KEYWORDS


register(
    name="abaqus",
    title="Abaqus",
    suffixes=(".inp",),
    encodings=("ascii",),
    read=deferred("hexmend.io.formats.abaqus.reader:read"),
    write=deferred("hexmend.io.formats.abaqus.writer:write"),
    capabilities=frozenset(Capability) - _LOST - {Capability.EMPTY_SETS, Capability.FIXED_NODES},
    stored_names=frozenset({"abaqus:type", "abaqus:types"}),
    limitations=deferred("hexmend.io.formats.abaqus.writer:limitations"),
    matches=_matches,
    locate=deferred("hexmend.io.formats.abaqus.reader:locate"),
    included=deferred("hexmend.io.formats.abaqus.deck:included_files_of"),
)
