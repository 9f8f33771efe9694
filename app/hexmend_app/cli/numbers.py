"""Numbers in the words of the command line."""

from __future__ import annotations

from hexmend.errors import ParameterError


def direction(text: str, option: str) -> tuple[float, ...]:
    """A vector, scaled so that its largest component is 1 or -1."""
    three = numbers(text, 3, option)
    largest = max(map(abs, three))
    if not largest > 0:
        raise wrong(option, text, "a direction that is not zero")
    return tuple(number / largest for number in three)


def span(text: str, option: str) -> tuple[float, ...]:
    """Two numbers, the lower first."""
    low, high = numbers(text, 2, option)
    if not low < high:
        raise wrong(option, text, "the lower number first, as in 0.2,0.8")
    return low, high


def numbers(text: str, count: int, option: str) -> tuple[float, ...]:
    """So many finite numbers."""
    try:
        found = tuple(float(word) for word in text.split(","))
    except ValueError:
        found = ()
    if len(found) != count or any(number != number or abs(number) == float("inf") for number in found):
        raise wrong(option, text, f"{count} number{'s' * (count > 1)} separated by commas")
    return found


def whole(text: str, option: str, low: int, high: int) -> int:
    """A whole number from `low` to `high`."""
    if not (text.isdecimal() and low <= int(text) <= high):
        raise wrong(option, text, f"a whole number from {low} to {high}")
    return int(text)


def wrong(option: str, text: str, expected: str) -> ParameterError:
    """What is said of a word that cannot be used."""
    return ParameterError(f"{option} {text!r} cannot be used: expected {expected}")
