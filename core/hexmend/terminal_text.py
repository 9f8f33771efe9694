"""Text for a terminal: control codes are replaced, and text that is shown in red is marked."""

from __future__ import annotations


def printable(text: str) -> str:
    r"""Replace what is not printable in a text, such as the codes that steer a terminal, and newlines by spaces.

    >>> printable("name\x1b[2J of\na file")
    'name?[2J of a file'
    """
    return "".join(letter if letter.isprintable() else "?" for letter in text.replace("\n", " "))


class WorsenedText(str):
    """Text of a value that is worse than it was; tables with colours show it in red."""
