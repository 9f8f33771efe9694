"""Checks that a file can be read, and errors of the file system as `FileError`."""

from __future__ import annotations

import difflib
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from hexmend.errors import FileError


def check_readable(path: Path, expected: str) -> None:
    """Raise a `FileError` unless the path is a readable regular file that is not empty.

    Parameters
    ----------
    path : Path
    expected : str
        Expected content for errors, such as "a mesh file".
    """
    try:
        if path.is_dir():
            raise FileError(path, f"is a folder: expected {expected}", "Choose a file in it.")
        if path.is_symlink() and not path.exists():
            raise FileError(path, "is a link to a file that does not exist", "Choose the file itself.")
        if not path.exists():
            raise FileError(path, f"there is no such file in {path.absolute().parent}", _nearest(path))
        if not path.is_file():
            raise FileError(path, "is not a regular file", "Save it to a file first.")
        if path.stat().st_size == 0:
            raise FileError(path, "is empty", "Write it again with the program that made it.")
    except (OSError, ValueError) as error:  # a folder without permission, an invalid name
        raise FileError(path, f"cannot be read: {getattr(error, 'strerror', None) or error}") from None
    if not os.access(path, os.R_OK):
        raise FileError(path, "cannot be read: permission denied", "Ask for permission to read it, or copy it.")


@contextmanager
def reading(path: Path, remedy: str) -> Iterator[None]:
    """Context manager that turns errors of the memory and the file system into a `FileError`.

    Parameters
    ----------
    path : Path
    remedy : str
        Advice where the memory does not suffice.
    """
    try:
        yield
    except MemoryError:
        raise FileError(path, "needs more memory than there is", remedy) from None
    except OSError as error:
        raise FileError(path, f"cannot be read: {error.strerror or error}") from None


def _nearest(path: Path) -> str:
    """Suggest a file of a similar name, as a sentence."""
    try:
        near = difflib.get_close_matches(path.name, (entry.name for entry in path.absolute().parent.iterdir()), n=1)
    except OSError:
        near = []
    return f"Did you mean {near[0]}?" if near else "Check the spelling."
