"""Lines of prose in pages of Markdown."""

from __future__ import annotations

from textwrap import fill


def wrapped(text: str, width: int = 120) -> str:
    """Break the lines of prose in a page that are longer than `width` characters; rows of tables stay whole.

    >>> print(wrapped("A long line.\\n| a | row of a table |", 8))
    A long
    line.
    | a | row of a table |
    """
    lines = text.split("\n")
    return "\n".join(
        fill(line, width, break_long_words=False, break_on_hyphens=False)
        if len(line) > width and not line.startswith("|")
        else line
        for line in lines
    )
