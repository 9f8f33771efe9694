"""Text for readers and their terminal: counts of things, text without control codes, and text that is shown in red."""

from __future__ import annotations

import os
import sys


def install_hint(extra: str) -> str:
    """Return the command that installs an extra.

    >>> install_hint("study")
    "run  pip install '.[study]'  in the source folder of Hexmend"
    """
    return f"run  pip install '.[{extra}]'  in the source folder of Hexmend"


def in_notebook() -> bool:
    """Return True in a cell of a notebook, where IPython shows what is displayed."""
    shell = getattr(sys.modules.get("IPython"), "get_ipython", lambda: None)()
    return getattr(shell, "kernel", None) is not None


def is_dumb() -> bool:
    """Return True if the variable TERM says that the terminal understands no control codes."""
    return os.environ.get("TERM", "").lower() in ("dumb", "unknown")


def shows_colours() -> bool:
    """Return True if standard output is printed in colours.

    NO_COLOR switches colours off; FORCE_COLOR switches them on for any output; else a terminal that is not dumb has
    them.
    """
    if os.environ.get("NO_COLOR"):
        return False
    return bool(os.environ.get("FORCE_COLOR")) or (sys.stdout.isatty() and not is_dumb())


def redraws_lines() -> bool:
    """Return True if standard error can show a line that changes in place."""
    isatty = getattr(sys.stderr, "isatty", None)  # a program without a console has no standard error
    return isatty is not None and (isatty() or bool(os.environ.get("FORCE_COLOR"))) and not is_dumb()


def printable(text: str) -> str:
    r"""Replace what is not printable in a text, such as the codes that steer a terminal, and newlines by spaces.

    >>> printable("name\x1b[2J of\na file")
    'name?[2J of a file'
    """
    return "".join(letter if letter.isprintable() else "?" for letter in text.replace("\n", " "))


def count_phrase(number: int, singular: str, plural: str | None = None) -> str:
    """Put a number before the singular or the plural of a phrase; the plural has an "s" more where none is given.

    >>> count_phrase(1, "hex is", "hexes are"), count_phrase(2000, "hex is", "hexes are"), count_phrase(0, "node")
    ('1 hex is', '2,000 hexes are', '0 nodes')
    """
    return f"{number:,} {singular if number == 1 else plural or f'{singular}s'}"


def listed(names: list[str], word: str) -> str:
    """List names with a word before the last.

    >>> listed([], "or"), listed(["a"], "or"), listed(["a", "b", "c"], "or")
    ('', 'a', 'a, b or c')
    """
    return f" {word} ".join(filter(None, [", ".join(names[:-1]), *names[-1:]]))


def capitalised(sentence: str) -> str:
    """Begin a sentence with a capital, and end it with a full stop; "" stays.

    >>> capitalised("the layers are kept"), capitalised("")
    ('The layers are kept.', '')
    """
    return f"{sentence[0].upper()}{sentence[1:].rstrip('.')}." if sentence else ""


class WorsenedText(str):
    """Text of a value that is worse than it was; tables with colours show it in red."""


class FailedText(str):
    """Text of a value of a run that did not arrive; tables of the thesis show it in italics."""


class ShortestText(str):
    """Text of the shortest time of a table; tables of the thesis show it in bold face."""
