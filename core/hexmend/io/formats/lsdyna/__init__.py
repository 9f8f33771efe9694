"""Keyword files of LS-DYNA (.k, .key, .dyn): nodes, solids, shells and beams, parts and sets.

*LS-DYNA Keyword User's Manual*, volume I: *NODE, *ELEMENT_SOLID, _TSHELL, _SHELL and _BEAM, *PART, *SET_NODE, _SOLID
and _SEGMENT, *INCLUDE, in fixed columns (standard, long, I10) or between commas.
"""

from __future__ import annotations

import re

from hexmend.io.base.format import Capability, deferred, register

_LOST = {
    Capability.NODE_DATA, Capability.HEX_DATA, Capability.FIELD_DATA, Capability.FIXED_NODES, Capability.SECOND_ORDER,
    Capability.EMPTY_SETS, Capability.CELL_SETS, Capability.VERTICES, Capability.LOWER_CELLS,
}  # fmt: skip
#: A first keyword that Abaqus does not have, behind comments and blank lines, or nodes in columns without commas.
_FIRST = re.compile(
    rb"(?:[ \t]*(?:\$[^\n]*)?\r?\n)*\*(?:KEYWORD|NODE\r?\n(?:\$[^\n]*\n)*[^\n,*]*\n|PART\r?\n|ELEMENT_)",
    re.IGNORECASE,
)

register(
    name="lsdyna",
    title="LS-DYNA",
    suffixes=(".k", ".key", ".dyn"),
    encodings=("ascii",),
    read=deferred("hexmend.io.formats.lsdyna.reader:read"),
    write=deferred("hexmend.io.formats.lsdyna.writer:write"),
    capabilities=frozenset(Capability) - _LOST,
    limitations=deferred("hexmend.io.formats.lsdyna.writer:limitations"),
    exact=False,  # a column of a coordinate has room for 16 letters
    matches=lambda head: _FIRST.match(head) is not None,
    locate=deferred("hexmend.io.formats.lsdyna.reader:locate"),
    included=deferred("hexmend.io.formats.lsdyna.deck:included_files_of"),
)
