"""Names in PVTU files: those of pieces, and of arrays that number the nodes and cells of all pieces."""

from __future__ import annotations

from pathlib import Path

from hexmend.io.formats.vtk.xml_document import Document

#: Arrays of the numbers, from 0, that nodes and cells of a piece have in the whole mesh.
NODE_ID, CELL_ID = "GlobalNodeId", "GlobalElementId"


def piece_names(path: Path) -> list[str]:
    """List the names of the pieces of a PVTU file.

    Raises
    ------
    FileError
        For another file, and for one without pieces.
    """
    with Document(path, "PUnstructuredGrid") as document:
        names = [piece.get("Source") for piece in document.root.first("PUnstructuredGrid").all("Piece")]
        if not names:
            raise document.error("lists no pieces")
    return names
