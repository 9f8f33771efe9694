"""Which suffixes something is written under."""

from __future__ import annotations

import os
from collections.abc import Collection
from pathlib import Path

from hexmend.errors import FileError


def suffix_for(path: str | os.PathLike[str], what: str, known: Collection[str]) -> str:
    """The suffix of a path, in small letters, once it is known that `what` can be written under it.

    Parameters
    ----------
    path : path-like
    what : str
        What is written, such as "a picture".
    known : collection of str
        The suffixes that there are, with the dot; "" among them admits a name without one.

    Returns
    -------
    str
        One of `known`.

    Raises
    ------
    FileError
        For another suffix: it names those that there are.

    Examples
    --------
    >>> suffix_for("figures/bridge.PNG", "a picture", [".png"])
    '.png'
    >>> suffix_for("bridge.pdf", "a table", [".csv", ".md", ".tex"])
    Traceback (most recent call last):
    hexmend.errors.FileError: bridge.pdf: a table cannot be written as .pdf. Use .csv, .md or .tex.
    """
    path = Path(path)
    suffix = path.suffix.lower()
    if suffix in known:
        return suffix
    *others, last = [one for one in known if one]
    listed = f"{', '.join(others)} or {last}" if others else last
    raise FileError(path, f"{what} cannot be written as {suffix or 'a file without a suffix'}", f"Use {listed}.")
