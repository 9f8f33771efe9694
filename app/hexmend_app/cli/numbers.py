"""Parsers of numbers in option values."""

from __future__ import annotations

from math import isfinite
from typing import Any

from hexmend.errors import ParameterError


def numbers(text: str, count: int, option: str) -> tuple[float, ...]:
    """Parse `count` numbers separated by commas, with or without brackets."""
    try:
        values = tuple(float(word) for word in text.strip("[] ").split(","))
    except ValueError:
        values = ()
    if len(values) != count or not all(map(isfinite, values)):
        raise invalid_value(option, text, f"{count} number{'s' * (count > 1)} separated by commas")
    return values


def parse_integer(text: str, option: str, low: int, high: int) -> int:
    """Parse an integer from `low` to `high`."""
    if not (text.isdecimal() and low <= int(text) <= high):
        raise invalid_value(option, text, f"a whole number from {low} to {high}")
    return int(text)


def page_size(text: str) -> dict[str, Any]:
    """Parse the value of `--size`, width and height in pixels, as keys of a page."""
    width, _, height = text.lower().partition("x")
    if not (width.isdecimal() and height.isdecimal() and 64 <= int(width) <= 8192 and 64 <= int(height) <= 8192):
        raise invalid_value("--size", text, "WIDTHxHEIGHT of 64 to 8192 pixels each, as in 1600x1000")
    return {"pixels": (int(width), int(height)), "width": None, "height": None}


def invalid_value(option: str, text: str, expected: str) -> ParameterError:
    """Return the error for an invalid value."""
    return ParameterError(f"{option} {text!r} cannot be used: expected {expected}")
