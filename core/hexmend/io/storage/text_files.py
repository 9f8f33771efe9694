"""Reading of text files that users write."""

from __future__ import annotations

import os
from pathlib import Path

from hexmend.errors import FileError
from hexmend.io.storage.readable import check_readable, reading


def read_text(path: str | os.PathLike[str], label: str, largest: int) -> str:
    """Read a text file in UTF-8.

    Parameters
    ----------
    path : path-like
    label : str
        Expected content for errors, such as "a recipe".
    largest : int
        Largest number of characters.

    Returns
    -------
    str

    Raises
    ------
    FileError
        Where the file cannot be read, is larger, or is not UTF-8: it names the line.
    """
    path = Path(path)
    check_readable(path, label)
    try:
        with reading(path, "Choose a smaller file."), open(path, "rb") as file:
            data = file.read(4 * largest + 4)  # bytes of `largest` characters
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = error.object.count(b"\n", 0, error.start) + 1
        raise FileError(path, f"is not text: line {line} holds bytes that are not UTF-8", f"Choose {label}.") from None
    if len(text) > largest:
        raise FileError(
            path, f"has {len(text):,} characters: expected {label}, of {largest:,} at most", f"Choose {label}."
        )
    return text
