"""Numbers as values of options."""

from __future__ import annotations

from math import isinf, isnan

from hexmend.errors import ParameterError


def direction(text: str, option: str) -> tuple[float, ...]:
    """Parse a vector, and scale it so that its largest component is 1 or -1."""
    three = numbers(text, 3, option)
    largest = max(map(abs, three))
    if not largest > 0:
        raise wrong(option, text, "a direction that is not zero")
    return tuple(number / largest for number in three)


def span(text: str, option: str, finite: bool = True) -> tuple[float, ...]:
    """Parse two numbers, the lower first."""
    low, high = numbers(text, 2, option, finite)
    if not low < high:
        raise wrong(option, text, "the lower number first, as in 0.2,0.8")
    return low, high


def numbers(text: str, count: int, option: str, finite: bool = True) -> tuple[float, ...]:
    """Parse `count` numbers, separated by commas; a list in brackets is read as well."""
    try:
        found = tuple(float(word) for word in text.strip("[] ").split(","))
    except ValueError:
        found = ()
    if len(found) != count or any(isnan(number) or (finite and isinf(number)) for number in found):
        raise wrong(option, text, f"{count} number{'s' * (count > 1)} separated by commas")
    return found


def whole(text: str, option: str, low: int, high: int) -> int:
    """Parse a whole number from `low` to `high`."""
    if not (text.isdecimal() and low <= int(text) <= high):
        raise wrong(option, text, f"a whole number from {low} to {high}")
    return int(text)


def parse_size(text: str) -> tuple[int, int]:
    """Parse the value of `--size`: width and height in pixels."""
    width, _, height = text.lower().partition("x")
    if not (width.isdecimal() and height.isdecimal() and 64 <= int(width) <= 8192 and 64 <= int(height) <= 8192):
        raise wrong("--size", text, "WIDTHxHEIGHT of 64 to 8192 pixels each, as in 1600x1000")
    return int(width), int(height)


def wrong(option: str, text: str, expected: str) -> ParameterError:
    """Return the error for a value that cannot be used."""
    return ParameterError(f"{option} {text!r} cannot be used: expected {expected}")
