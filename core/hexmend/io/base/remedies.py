"""Advice that readers of several formats give in their errors.

Notes on content of a file that is not part of its mesh: a file that is written anew does not have it.

Limit on the memory for the arrays of a file, so that a small damaged file cannot exhaust it.
"""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from hexmend.errors import FileError
from hexmend.terminal_text import count_phrase

#: For a file whose content contradicts itself or ends early.
DAMAGED = "Write the file again with the program that made it: it is damaged or cut short."


def check_suffix(kind: str) -> str:
    """Return the advice for a file that is not of the kind that its suffix says.

    >>> check_suffix("a Gmsh file")
    'Check that this is a Gmsh file; if not, correct its suffix.'
    """
    return f"Check that this is {kind}; if not, correct its suffix."


_BEGIN = "Not read: "


def unread_note(content: str) -> str:
    """Return the note of a reader on content that it does not read.

    Parameters
    ----------
    content : str
        A phrase such as "sections ($Comments)".

    Examples
    --------
    >>> unread_note("2 cells of type POLYGON")
    'Not read: 2 cells of type POLYGON.'
    """
    return f"{_BEGIN}{content}."


def unread_content(notes: Iterable[str]) -> list[str]:
    """Return the phrases of all notes by `unread_note`.

    Parameters
    ----------
    notes : iterable of str
        Of a mesh that was read.

    Examples
    --------
    >>> unread_content(["The mesh was turned.", unread_note("2 cells of type POLYGON")])
    ['2 cells of type POLYGON']
    """
    return [note.removeprefix(_BEGIN).removesuffix(".") for note in notes if note.startswith(_BEGIN)]


def some_names(names: Iterable[str], count: int = 6) -> str:
    """Join the first names of many.

    Parameters
    ----------
    names : iterable of str
    count : int
        Most names that are joined.

    Examples
    --------
    >>> some_names("abcd", 2), some_names("abc", 2), some_names("ab", 2)
    ('a, b and 2 others', 'a, b and 1 other', 'a, b')
    """
    names = list(names)
    more = len(names) - count
    return ", ".join(names[:count]) + (f" and {count_phrase(more, 'other')}" if more > 0 else "")


#: Bytes that the arrays of any file may have, and further bytes for each byte of the file. Compression reaches 650
#: for constant arrays only.
_BASE, _BYTES_PER_BYTE = 1 << 26, 100


class MemoryBudget:
    """Budget of bytes for the arrays of one file.

    Parameters
    ----------
    path : Path
        Named in errors.
    size : int
        Size of the file in bytes.
    """

    def __init__(self, path: Path, size: int):
        self.path, self.size, self.announced = path, size, 0

    def charge(self, size: int, label: str) -> None:
        """Add the announced size of an array, before it is read.

        Parameters
        ----------
        size : int
            Bytes.
        label : str
            The array, for errors.

        Raises
        ------
        FileError
            Where all arrays together exceed the budget.
        """
        self.announced += size
        if self.announced > _BASE + _BYTES_PER_BYTE * self.size:
            problem = f"{label} and the arrays before it are declared to have {self.announced >> 20:,} MB"
            raise FileError(self.path, f"{problem}: too many for a file of {max(1, self.size >> 10):,} kB", DAMAGED)
