"""Check of the suffix of a file to be written."""

from __future__ import annotations

import os
from collections.abc import Collection
from pathlib import Path

from hexmend.errors import FileError
from hexmend.terminal_text import listed


def suffix_for(path: str | os.PathLike[str], label: str, known: Collection[str]) -> str:
    """Return the suffix of a path in lower case after a check that it is supported.

    Parameters
    ----------
    path : path-like
    label : str
        The thing to be written, for errors, such as "a picture".
    known : collection of str
        Supported suffixes, with the dot; "" allows a name without one.

    Returns
    -------
    str
        One of `known`.

    Raises
    ------
    FileError
        For another suffix: it lists the supported ones.

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
    remedy = f"Use {listed([name for name in known if name], 'or')}."
    raise FileError(path, f"{label} cannot be written as {suffix or 'a file without a suffix'}", remedy)
