"""Reader of the texts in PNG files, which does not decode pixels and accepts untrusted files."""

from __future__ import annotations

import os
import struct
import zlib
from collections.abc import Collection
from pathlib import Path

from hexmend.errors import FileError

_SIGNATURE = b"\x89PNG\r\n\x1a\n"

#: Maximum number of chunks that are read, and maximum size of a text in bytes; compressed texts are skipped.
_MAX_CHUNKS, _MAX_BYTES = 100_000, 4_200_000


def is_png(path: str | os.PathLike[str]) -> bool:
    """Return True if a file begins with the PNG signature."""
    try:
        with open(path, "rb") as file:
            return file.read(len(_SIGNATURE)) == _SIGNATURE
    except (OSError, ValueError):  # the error is reported when the file is read
        return False


def texts(path: str | os.PathLike[str], keywords: Collection[str]) -> dict[str, str]:
    """Return the texts of a PNG with the given keywords; the last text of each keyword counts.

    Raises
    ------
    FileError
        If the file cannot be read or is damaged, or a text is too large.
    """
    path, found = Path(path), dict[str, str]()
    try:
        with open(path, "rb") as file:
            size = file.seek(0, os.SEEK_END)
            file.seek(len(_SIGNATURE))
            for _ in range(_MAX_CHUNKS):
                header = file.read(8)
                if len(header) < 8 or header[4:] == b"IEND":
                    break
                (length,) = struct.unpack(">I", header[:4])
                end = file.tell() + length + 4
                if end > size:
                    raise FileError(path, "ends in the middle of a picture", "Copy the picture again.")
                if header[4:] == b"iTXt":
                    found |= _text(path, file.read(min(length, _MAX_BYTES + 1)), keywords, file.read(4))
                file.seek(end)
    except OSError as error:
        raise FileError(path, f"cannot be read: {error.strerror or error}") from None
    return found


def _text(path: Path, data: bytes, keywords: Collection[str], checksum: bytes) -> dict[str, str]:
    """Return the text of an iTXt chunk by its keyword; empty for other keywords and compressed texts."""
    keyword, _, rest = data[:80].partition(b"\0")
    if keyword.decode("latin-1") not in keywords or rest[:1] == b"\1":
        return {}
    if len(data) > _MAX_BYTES:
        raise FileError(path, f"contains a text of more than {_MAX_BYTES:,} bytes", "Save the picture again.")
    if zlib.crc32(b"iTXt" + data) != int.from_bytes(checksum, "big"):
        raise FileError(path, "contains a damaged text", "Copy the picture again.")
    # Keyword, compression flag and method, language, translated keyword, text.
    parts = data[len(keyword) + 3 :].split(b"\0", 2)
    try:
        return {keyword.decode("ascii"): parts[2].decode("utf-8")}
    except (IndexError, UnicodeDecodeError):
        raise FileError(path, "contains a damaged text", "Copy the picture again.") from None
