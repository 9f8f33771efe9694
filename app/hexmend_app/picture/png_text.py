"""Texts that a PNG carries, read without its pixels; the file may come from anywhere."""

from __future__ import annotations

import os
import struct
import zlib
from collections.abc import Collection
from pathlib import Path

from hexmend.errors import FileError

_SIGNATURE = b"\x89PNG\r\n\x1a\n"

#: Chunks that are looked at, and bytes of a text; a compressed one, which could be of any size, is passed over.
_MOST_CHUNKS, _LARGEST = 100_000, 4_200_000


def is_png(path: str | os.PathLike[str]) -> bool:
    """Return True if a file begins as a PNG does."""
    try:
        with open(path, "rb") as file:
            return file.read(len(_SIGNATURE)) == _SIGNATURE
    except (OSError, ValueError):  # whoever reads it says why it cannot be read
        return False


def texts(path: str | os.PathLike[str], keywords: Collection[str]) -> dict[str, str]:
    """The texts of a PNG by keyword, of those that are asked for: the last of each.

    Raises
    ------
    FileError
        Where the file cannot be read, is damaged, or a text is larger than such texts are.
    """
    path, found = Path(path), {}
    try:
        with open(path, "rb") as file:
            size = file.seek(0, os.SEEK_END)
            file.seek(len(_SIGNATURE))
            for _ in range(_MOST_CHUNKS):
                head = file.read(8)
                if len(head) < 8 or head[4:] == b"IEND":
                    break
                (length,) = struct.unpack(">I", head[:4])
                after = file.tell() + length + 4
                if after > size:
                    raise FileError(path, "ends in the middle of a picture", "Copy the picture again.")
                if head[4:] == b"iTXt":
                    found |= _text(path, file.read(min(length, _LARGEST + 1)), keywords, file.read(4))
                file.seek(after)
    except OSError as error:
        raise FileError(path, f"cannot be read: {error.strerror or error}") from None
    return found


def _text(path: Path, data: bytes, keywords: Collection[str], sum_: bytes) -> dict[str, str]:
    """The text of a chunk, by its keyword, where that is asked for."""
    keyword, _, rest = data[:80].partition(b"\0")
    if keyword.decode("latin-1") not in keywords or rest[:1] == b"\1":
        return {}
    if len(data) > _LARGEST:
        raise FileError(path, f"carries a text of more than {_LARGEST:,} bytes", "Save the picture again.")
    if zlib.crc32(b"iTXt" + data) != int.from_bytes(sum_, "big"):
        raise FileError(path, "carries a text that is damaged", "Copy the picture again.")
    # Keyword, whether it is compressed and how, language, the keyword in it, and the text.
    parts = data[len(keyword) + 3 :].split(b"\0", 2)
    try:
        return {keyword.decode("ascii"): parts[2].decode("utf-8")}
    except (IndexError, UnicodeDecodeError):
        raise FileError(path, "carries a text that is damaged", "Copy the picture again.") from None
