"""Parsing of TOML text of unknown origin: bounded in size, with problems located by line and column."""

from __future__ import annotations

import re
from typing import Any

from hexmend.errors import ParameterError

#: Largest number of characters of a text, and of parts of a key: a parser needs memory quadratic in the latter.
MAX_CHARACTERS, MAX_KEY_PARTS = 1_000_000, 8

#: Strings of several lines and of one, and comments; an unterminated one extends as far as a parser would read.
_STRING_OR_COMMENT = re.compile(
    r'"""(?:\\.|[^"\\]|"(?!""))*+(?:"{3,5})?'
    r"|'''(?:[^']|'(?!''))*+(?:'{3,5})?"
    r'|"(?:\\[^\n]|[^"\\\n])*+"?'
    r"|'[^'\n]*+'?"
    r"|#[^\n]*+",
    re.DOTALL,
)

#: Dots of a key with too many parts.
_DEEP_KEY = re.compile(rf'(?:\.[ \t]*+(?:[\w-]++|"")?[ \t]*+){{{MAX_KEY_PARTS + 1}}}')


def parse_toml(text: str, label: str, largest: int = MAX_CHARACTERS) -> dict[str, Any]:
    """Parse a TOML text.

    Parameters
    ----------
    text : str
    label : str
        Name of the expected content in messages, such as "a recipe".
    largest : int
        Largest number of characters.

    Returns
    -------
    dict

    Raises
    ------
    ParameterError
        For text that is not TOML, too long or nested too deeply; the message names the line.

    Examples
    --------
    >>> parse_toml("a = [1, 2]", "a recipe")
    {'a': [1, 2]}
    >>> parse_toml("a = ", "a recipe")
    Traceback (most recent call last):
    hexmend.errors.ParameterError: is not TOML: invalid value (at line 1, column 5, the end)
    """
    import tomllib

    if len(text) > largest:
        raise ParameterError(f"has {len(text):,} characters: expected {label}, of {largest:,} at most")
    # Strings may contain anything and may be keys: each is replaced by an empty one with as many lines.
    bare = _STRING_OR_COMMENT.sub(lambda found: '""' + "\n" * found[0].count("\n"), text)
    if deep := _DEEP_KEY.search(bare):
        number = bare.count("\n", 0, deep.start()) + 1
        raise ParameterError(f"line {number} has a key of more than {MAX_KEY_PARTS} parts")
    try:
        return tomllib.loads(text)
    except RecursionError:
        raise ParameterError(f"is nested too deeply to be {label}") from None
    except ValueError as error:  # tomllib's error, or that of a number with thousands of digits
        lines = text.splitlines() or [""]
        end = f"at line {len(lines)}, column {len(lines[-1]) + 1}, the end"
        message = str(error).replace("at end of document", end)
        raise ParameterError(f"is not TOML: {message[:1].lower()}{message[1:]}") from None
