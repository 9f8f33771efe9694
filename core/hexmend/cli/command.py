"""What a command is, and what commands share.

Commands of other distributions join through the entry-point group `hexmend.commands`.
"""

from __future__ import annotations

import argparse
from typing import Protocol


class Command(Protocol):
    """A word of the command line.

    A module under `cli` names its command `command`. Importing the module must be cheap: what is heavy is imported in
    `run`.
    """

    name: str
    help: str

    def arguments(self, parser: argparse.ArgumentParser) -> None:
        """Declare the command's arguments."""

    def run(self, args: argparse.Namespace) -> int:
        """Do it; return the exit status. Problems of the user's are raised as `HexmendError`."""


def settings(words: list[str]) -> dict[str, str]:
    """`key=value` words of --set as a mapping.

    >>> settings(["p=4", "delta=0.1"])
    {'p': '4', 'delta': '0.1'}
    """
    from hexmend.errors import ParameterError

    for word in words:
        if "=" not in word:
            raise ParameterError(f"--set {word!r} is incomplete: expected key=value, as in --set p=4")
    return dict(word.split("=", 1) for word in words)
