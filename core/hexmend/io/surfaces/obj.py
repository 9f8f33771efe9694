"""Wavefront's OBJ, parsed by meshlane.

trimesh is not used: it splits quads, misreads a face whose corners are written in several forms, such as
`1/1/1 2/1/1 3//1 4/1`, and takes 0.5 s to import.
"""

from __future__ import annotations

import io
import re
from pathlib import Path

from hexmend.io.surfaces.format import Polygons, parse_surface, polygons_from_meshlane


def read(path: Path) -> Polygons:
    """Read an OBJ file: its vertices and faces."""
    from meshlane import obj

    text = path.read_text(encoding="utf-8", errors="replace").replace("\\\n", " ")
    return parse_surface(path, "OBJ", lambda: polygons_from_meshlane(obj.read(io.StringIO(_normalised(text)))))


def _normalised(text: str) -> str:
    """Keep vertices and faces only, and make negative (relative) vertex numbers of faces positive."""
    lines, count = [], 0
    for line in text.splitlines():
        word, *rest = line.partition("#")[0].split() or [""]
        if word == "v":
            count += 1
            lines.append(" ".join(["v", *rest[:3]]))
        elif word == "f":
            nodes = " ".join(rest)
            lines.append("f " + re.sub(r"(?<!\S)-(\d+)\S*", lambda found, n=count: str(n + 1 - int(found[1])), nodes))
    return "\n".join(lines)
