"""STL, in decimals and binary, parsed by meshlane."""

from __future__ import annotations

import io
import re
from pathlib import Path

from hexmend.errors import FileError
from hexmend.io.surfaces.format import DAMAGED, SURFACES, Polygons, SurfaceFormat, of_meshlane, parsed

#: Bytes before the triangles of a binary file, and of each of them.
_HEAD, _TRIANGLE = 84, 50


def read(path: Path) -> Polygons:
    """Read an STL file; each triangle has corners of its own."""
    from meshlane.stl import _stl

    data = path.read_bytes()
    if len(data) >= _HEAD:
        count = int.from_bytes(data[_HEAD - 4 : _HEAD], "little")
        if len(data) == _HEAD + _TRIANGLE * count:
            return parsed(path, "binary STL", lambda: of_meshlane(_stl.read(str(path))))
    if data.lstrip()[:5].lower() != b"solid":
        have = max(len(data) - _HEAD, 0) / _TRIANGLE
        raise FileError(
            path, f"is no STL: it begins without 'solid' and ends after {have:.1f} binary triangles", DAMAGED
        )
    return parsed(path, "STL", lambda: of_meshlane(_stl._read_ascii(io.BytesIO(_in_form(data)))))


def _in_form(data: bytes) -> bytes:
    """The facets as meshlane takes them: in small letters, without blank lines and what names the solids."""
    lines = re.split(rb"[\r\n]+", data.lower())
    return b"\n".join(line for line in map(bytes.strip, lines) if line.startswith((b"facet", b"vertex")))


SURFACES.add("stl", SurfaceFormat("stl", "STL", (".stl",), read))
