"""Gmsh's format (.msh): versions 1, 2 and 4.1 are read, 4.1 is written, as text and binary.

*Gmsh Reference Manual*, "MSH file format" (version 4.1) and "Legacy formats" (versions 1 and 2).
"""

from hexmend.io.base.format import Capability, deferred, register

_LOST = {Capability.NODE_SETS, Capability.SIDE_SETS, Capability.EMPTY_SETS, Capability.FIELD_DATA}


register(
    name="gmsh",
    title="Gmsh",
    suffixes=(".msh",),
    encodings=("binary", "ascii"),
    read=deferred("hexmend.io.formats.gmsh.reader:read"),
    write=deferred("hexmend.io.formats.gmsh.writer:write"),
    capabilities=frozenset(Capability) - _LOST,
    stored_names=frozenset({"gmsh:physical"}),
    limitations=deferred("hexmend.io.formats.gmsh.writer:limitations"),
    matches=lambda head: b"$MeshFormat" in head or head.lstrip().startswith(b"$NOD"),
    locate=deferred("hexmend.io.formats.gmsh.reader:locate"),
)
