"""Medit's format in binary (.meshb), versions 1 to 4, as libMeshb describes it."""

from __future__ import annotations

import struct
from pathlib import Path

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.cursor import ByteCursor
from hexmend.io.base.format import Format, register
from hexmend.io.formats.medit.content import CAPABILITIES, SECTIONS, STORED_NAMES, from_mesh, limitations, to_mesh
from hexmend.mesh.mesh import Mesh

_DIMENSION, _VERTICES, _END = 3, 4, 54
_BY_CODE = {section.code: section for section in SECTIONS.values()}


def read(path: Path) -> Mesh:
    """Read a binary Medit file of either byte order."""
    source = ByteCursor(path, path.read_bytes(), is_text=False)
    head = source.read_bytes(4, "the head")
    order = {b"\x01\x00\x00\x00": "<", b"\x00\x00\x00\x01": ">"}.get(head)
    if order is None:
        raise source.error("does not begin with the number 1", "Is it a binary Medit file? Check its suffix.")
    (version,) = struct.unpack(f"{order}i", source.read_bytes(4, "the version"))
    if not 1 <= version <= 4:
        raise source.error(f"is of version {version}: expected 1 to 4")
    whole = f"{order}i8" if version == 4 else f"{order}i4"
    real = f"{order}f4" if version == 1 else f"{order}f8"
    offset = f"{order}q" if version >= 3 else f"{order}i"

    points = refs = None
    sections: dict[str, np.ndarray] = {}
    seen = 0
    while source.pos < len(source.data):
        at = source.pos
        (code,) = struct.unpack(f"{order}i", source.read_bytes(4, "a section's number"))
        if code == _END:
            break
        (after,) = struct.unpack(offset, source.read_bytes(struct.calcsize(offset), "the place of the next section"))
        if code == _DIMENSION:
            (dimension,) = struct.unpack(f"{order}i", source.read_bytes(4, "the dimension"))
            if dimension != 3:
                raise source.error(f"its dimension is {dimension}: expected 3", "Hexmend works in space.")
            continue
        seen += 1
        if code == _VERTICES or code in _BY_CODE:
            name = "Vertices" if code == _VERTICES else _BY_CODE[code].name
            count = int(source.read_binary(f"the number of {name}", 1, 1, whole)[0, 0])
            if count < 0:
                raise source.error(f"the number of {name} at byte {at} is {count}: expected a natural number")
            if code == _VERTICES:
                rows = source.read_binary(name, count, 1, [("x", real, 3), ("ref", whole)])
                points, refs = rows["x"][:, 0].astype(np.float64), rows["ref"][:, 0].astype(np.int64)
            else:
                sections[name] = source.read_binary(name, count, _BY_CODE[code].width, whole).astype(np.int64)
        elif not source.pos <= after <= len(source.data):
            raise source.error(f"the section of number {code} at byte {at} leads to byte {after}, outside the file")
        else:
            source.pos = after  # a section that says nothing about hexes
    if points is None:
        raise source.error(f"has no section Vertices among its {seen}")
    return to_mesh(path, points, refs, sections)


def write(path: Path, mesh: Mesh, encoding: str) -> None:
    """Write version 2, or 3 where the file grows beyond what version 2 can address."""
    points, refs, sections = from_mesh(mesh)
    large = len(points) * 28 + sum(rows.size * 4 + 12 for rows in sections.values()) > 2**31 - 1024
    version, offset = (3, "<q") if large else (2, "<i")
    limit = np.iinfo(np.int32)
    for name, rows in (("Vertices", refs), *sections.items()):
        if rows.size and (rows.min() < limit.min or rows.max() > limit.max):
            raise FileError(path, f"a reference of {name} needs more than 32 bits", "Write .mesh or .vtu instead.")
    vertices = np.empty(len(points), [("x", "<f8", 3), ("ref", "<i4")])
    vertices["x"], vertices["ref"] = points, refs
    with open(path, "wb") as file:

        def head(code: int, size: int) -> None:
            file.write(struct.pack("<i", code))
            file.write(struct.pack(offset, file.tell() + struct.calcsize(offset) + size))

        file.write(struct.pack("<ii", 1, version))
        head(_DIMENSION, 4)
        file.write(struct.pack("<i", 3))
        for code, rows in ((_VERTICES, vertices), *((SECTIONS[k].code, v.astype("<i4")) for k, v in sections.items())):
            head(code, 4 + rows.nbytes)
            file.write(struct.pack("<i", len(rows)))
            file.write(rows.tobytes())
        file.write(struct.pack("<i", _END))
        file.write(struct.pack(offset, 0))


register(
    Format(
        name="medit-binary",
        title="binary Medit",
        suffixes=(".meshb",),
        encodings=("binary",),
        read=read,
        write=write,
        capabilities=CAPABILITIES,
        stored_names=STORED_NAMES,
        limitations=limitations,
    )
)
