"""The parser of a command's words, which reports a mistake in one line with the nearest name."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from typing import Any, NoReturn

from hexmend.parameters import suggestion

_MISSING = "the following arguments are required: "


class Parser(argparse.ArgumentParser):
    """Parser of a command: every mistake is one line on standard error, and the exit status is 2.

    Parameters
    ----------
    name, text : str
        Name of the command, and what it does.
    """

    def __init__(self, name: str, text: str):
        super().__init__(prog=f"hexmend {name}", description=text, allow_abbrev=False)
        self._words: Sequence[str] = ()

    def parse(self, words: Sequence[str]) -> argparse.Namespace:
        """Return the values of the arguments; `SystemExit` after the help or the report of a mistake."""
        self._words = words
        known, unknown = self.parse_known_args(words)
        if unknown:
            self.error(self._unknown(unknown[0]))
        for action in self._actions:
            value = getattr(known, action.dest, None)
            if value != action.default and (value == "" or (isinstance(value, list) and "" in value)):
                self.error(f"{_name(action)} is empty: expected a value")
        return known

    def error(self, message: str) -> NoReturn:
        """Report a mistake, and end the program."""
        if message.startswith(_MISSING):  # an option that is misspelt may be the one that is missing
            options = [word for word in self._words if word.startswith("--")]
            misspelt = [word for word in options if word.partition("=")[0] not in self._option_string_actions]
            names = message.removeprefix(_MISSING).split(", ")
            message = self._unknown(misspelt[0]) if misspelt else self._missing(names)
        end = "" if message.endswith("?") else "."
        print(f"{self.prog}: {message}{end} {self.prog} --help lists the options.", file=sys.stderr)
        sys.exit(2)

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        if action.choices is None or value in action.choices:
            return
        known = [str(one) for one in action.choices]
        self.error(f"{_name(action)} {value} is unknown: {suggestion(str(value), known)}expected {' or '.join(known)}")

    def _unknown(self, word: str) -> str:
        """Return the sentence for a word that is neither an option nor the place of an argument."""
        if not word.startswith("-"):
            return f"{word!r} is one word too many"
        option = word.partition("=")[0]
        hint = suggestion(option, self._option_string_actions).rstrip()
        return f"there is no option {option}" + (f": {hint}" if hint else "")

    def _missing(self, names: Sequence[str]) -> str:
        """Return the sentence for arguments that are missing, each with its help."""
        missing = [one for one in self._actions if _identity(one) in names and one.nargs != "*"]
        return "missing: " + ", and ".join(f"{_usage(one)} ({one.help})" for one in missing)


def _name(one: argparse.Action) -> str:
    """Return the name of an option, or of an argument in upper case."""
    return one.option_strings[-1] if one.option_strings else one.dest.upper()


def _identity(one: argparse.Action) -> str:
    """Return the name that argparse uses for an action in its messages."""
    return "/".join(one.option_strings) or str(one.metavar or one.dest)


def _usage(one: argparse.Action) -> str:
    return f"{one.option_strings[0]} {one.metavar or one.dest.upper()}" if one.option_strings else str(one.metavar)
