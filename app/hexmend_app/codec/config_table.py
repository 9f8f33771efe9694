"""Tables of keys with defaults and bounds, which are the parts of a scene.

A table is a frozen dataclass; its docstring explains the keys, and its fields declare their bounds.
"""

from __future__ import annotations

from dataclasses import dataclass

from hexmend_app.codec.conversion import decode_key
from hexmend_app.codec.option import options_of


@dataclass(frozen=True)
class ConfigTable:
    """Base of tables; checks values and converts them to their types on construction.

    Raises
    ------
    ParameterError
        If a value is invalid; names the key, the value and what was expected.
    """

    def __post_init__(self) -> None:
        for option in options_of(type(self)):  # type: ignore[arg-type]  # mypy takes no class as hashable
            object.__setattr__(self, option.field, decode_key(option, getattr(self, option.field)))
        self.check()

    def check(self) -> None:
        """Raise `ParameterError` if keys contradict each other."""
