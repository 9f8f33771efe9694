"""Links in CGNS files of the ADF kind, which the CGNS library follows into whatever file they name."""

from __future__ import annotations

import mmap
import struct
from pathlib import Path

from hexmend.errors import FileError

#: Where a file of this kind says what it is, and what it says; the library takes any other for one on HDF5.
_KIND = slice(4, 24), b"ADF Database Version"
#: How the head of a node begins, and its bytes: the name at 4, the type at 96, which is "LK" of a link, the number of
#: chunks of data at 226, and the block and the offset of these at 230.
_NODE, _HEAD = b"NoDe", 246
#: Bytes of a block; and of what stands before the text of a link that follows its head at once.
_BLOCK, _BEFORE = 4096, 16


def check_links(path: Path) -> None:
    """Raise a `FileError` where a node is a link to another file.

    The text of a link is the name of a file, ">", and a path in it; inside the same file the name is empty.
    """
    with open(path, "rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as data:
        if data[_KIND[0]] != _KIND[1]:
            raise FileError(path, "has not the head of a CGNS file of the ADF kind", "Write it again, on HDF5.")
        at = data.find(_NODE)
        while at >= 0:
            head = data[at : at + _HEAD]
            if head[96:98] == b"LK" and not _is_inside(data, head, at + _HEAD):
                name = head[4:36].decode("ascii", "replace").strip()
                raise FileError(
                    path,
                    f"its {name!r} is a link to another file: no other file is opened",
                    "Write all data into one file with the program that made it.",
                )
            at = data.find(_NODE, at + 1)


def _is_inside(data: mmap.mmap, head: bytes, end: int) -> bool:
    """Return True if the text of a link follows its head at once and names no file."""
    block, offset = divmod(end, _BLOCK)
    places = (struct.pack("<qi", block, offset), struct.pack(">qi", block, offset), b"%08X%04X" % (block, offset))
    follows = head[226:230] == b"0001" and head[230:242].upper() in {place.upper() for place in places}
    return follows and data[end : end + 4] == b"DaTa" and data[end + _BEFORE : end + _BEFORE + 1] == b">"
