"""Stanford's PLY, in decimals and binary, parsed by meshlane.

trimesh is not used: it splits quads and reads a file that is cut short as a smaller surface. VTK's reader crashes on
one.
"""

from __future__ import annotations

import io
import re
from pathlib import Path

from hexmend.errors import FileError
from hexmend.io.base.remedies import check_suffix
from hexmend.io.surfaces.format import Polygons, parse_surface, polygons_from_meshlane

_END = b"end_header"


def read(path: Path) -> Polygons:
    """Read a PLY file: its vertices and faces."""
    from meshlane import ply

    data = path.read_bytes()
    head, end, rest = data.partition(_END)
    if not head.startswith(b"ply") or not end:
        raise FileError(path, "has no header from 'ply' to 'end_header'", check_suffix("a PLY file"))
    if not re.search(rb"\n\s*element vertex 0*[1-9]", head):
        problem = "holds no surface: expected vertices and faces, its header declares no vertex"
        raise FileError(path, problem, "Choose a file with a surface.")
    # The list of vertices has two names in use; meshlane knows one of them.
    head = head.replace(b"\r\n", b"\n").replace(b" vertex_index\n", b" vertex_indices\n")
    rest = b"\n" + rest.lstrip(b"\r")[1:]
    return parse_surface(path, "PLY", lambda: polygons_from_meshlane(ply.read(io.BytesIO(head + end + rest))))
