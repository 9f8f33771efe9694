"""Check for links to other files in CGNS files based on ADF, which the CGNS library would follow."""

from __future__ import annotations

import mmap
import struct
from pathlib import Path

from hexmend.errors import FileError

#: Position and text of the file signature; the CGNS library treats all other files as HDF5.
_SIGNATURE = slice(4, 24), b"ADF Database Version"
#: Signature and length of a node header, in bytes: its name is at 4, its type at 96 ("LK" for a link), the number of
#: data chunks at 226, and their block and offset at 230.
_NODE, _HEADER = b"NoDe", 246
#: Length of a block, and offset of the text in the data of a link, in bytes.
_BLOCK, _TEXT_OFFSET = 4096, 16


def check_links(path: Path) -> None:
    """Raise `FileError` if a node is a link to another file.

    The text of a link consists of a file name, ">", and a path in the file; the name is empty for links within a file.
    """
    with open(path, "rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as data:
        if data[_SIGNATURE[0]] != _SIGNATURE[1]:
            raise FileError(
                path, "is not a CGNS file based on ADF: its signature is missing", "Write it again, based on HDF5."
            )
        at = data.find(_NODE)
        while at >= 0:
            header = data[at : at + _HEADER]
            if header[96:98] == b"LK" and not _is_internal(data, header, at + _HEADER):
                name = header[4:36].decode("ascii", "replace").strip()
                raise FileError(
                    path,
                    f"its node {name!r} is a link to another file, which is not followed",
                    "Write all data into one file with the program that made it.",
                )
            at = data.find(_NODE, at + 1)


def _is_internal(data: mmap.mmap, header: bytes, end: int) -> bool:
    """Return True if the text of a link immediately follows its header and has no file name."""
    block, offset = divmod(end, _BLOCK)
    addresses = struct.pack("<qi", block, offset), struct.pack(">qi", block, offset), b"%08X%04X" % (block, offset)
    follows = header[226:230] == b"0001" and header[230:242].upper() in {address.upper() for address in addresses}
    return follows and data[end : end + 4] == b"DaTa" and data[end + _TEXT_OFFSET : end + _TEXT_OFFSET + 1] == b">"
