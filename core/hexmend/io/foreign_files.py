"""Files that no format reads, recognised by how they begin, and the way to a file that can be read."""

from __future__ import annotations

import re
from pathlib import Path

from hexmend.errors import FileError

#: How a file begins, what it is, and what to do.
_KINDS = (
    (rb"version https://git-lfs", "is a pointer of Git LFS, not the file itself", "Fetch it: git lfs pull."),
    (
        rb"MFEM (?:NC )?mesh|MFEM NURBS|MFEM INLINE",
        "is a mesh of MFEM",
        "Open it in MFEM's mesh-explorer and save it as VTK (key V).",
    ),
    (
        rb"\s*\(\s*(?:0|1|2|10|12|13|39|45)\s",
        "is a mesh of Fluent",
        "Convert it with OpenFOAM's fluent3DMeshToFoam, and open the case.",
    ),
    (rb"# Created by COMSOL", "is a mesh of COMSOL", "Export it from COMSOL as NASTRAN (.nas)."),
    (
        rb"(?:libMesh-|DEAL |LIBM |MESH )",
        "is a mesh of libMesh",
        "Convert it with libMesh: meshtool-opt -i MESH.xda -o MESH.e.",
    ),
    (
        rb"\s+-1\s+(?:151|15|164|2411|2420|780)\b",
        "is a universal file (UNV)",
        "Convert it with Gmsh: gmsh MESH.unv -save -o MESH.msh.",
    ),
    (rb"#RADIOSS STARTER", "is a deck of Radioss", "Export it from HyperMesh as Nastran or LS-DYNA."),
    (
        rb"\s*(?:<\?xml[^>]*>\s*)?<febio_spec",
        "is a deck of FEBio",
        "Export the mesh from FEBio Studio as VTK or LS-DYNA (.k).",
    ),
)


def check_not_foreign(path: Path, head: bytes) -> None:
    """Raise `FileError` for a file of a kind that is known and not read; it says what it is, and what to do.

    Parameters
    ----------
    path : Path
    head : bytes
        First bytes of the file.
    """
    for pattern, kind, remedy in _KINDS:
        if re.match(pattern, head):
            raise FileError(path, kind, remedy)
