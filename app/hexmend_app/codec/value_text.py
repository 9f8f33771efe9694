"""Values of keys as typed by users."""

from __future__ import annotations

from typing import Any

from hexmend.errors import ParameterError
from hexmend.toml_text import parse_toml


def parse_value(text: str) -> Any:
    """Return a value of TOML, a list without its brackets, or a text without quotes.

    >>> parse_value("0.5"), parse_value("0.2,0.8"), parse_value("true"), parse_value("-x"), parse_value("{ rings = 0 }")
    (0.5, [0.2, 0.8], True, '-x', {'rings': 0})
    """
    for notation in (text, f"[{text}]"):
        try:
            return parse_toml(f"value = {notation}", "a value")["value"]
        except ParameterError:
            continue
    return text
