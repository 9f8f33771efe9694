"""Tables of keys with defaults and bounds, which are the parts of a scene.

A table is a frozen dataclass; its docstring explains the keys, and its fields declare their bounds.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Self

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
        self._set(vars(self))
        self.check()

    def _set(self, values: Mapping[str, Any]) -> None:
        """Check and convert values by field, and set them."""
        for option in options_of(type(self)):  # type: ignore[arg-type]  # mypy takes no class as hashable
            if option.field in values:
                object.__setattr__(self, option.field, decode_key(option, values[option.field]))

    def with_keys(self, **values: Any) -> Self:
        """Return a copy with other values of fields; only these are checked again, which saves time for long lists.

        Raises
        ------
        ParameterError
            If a value is invalid.
        TypeError
            If a field does not exist.
        """
        fields = [option.field for option in options_of(type(self))]  # type: ignore[arg-type]
        if unknown := values.keys() - set(fields):
            raise TypeError(f"{type(self).__name__} has no fields {', '.join(sorted(unknown))}")
        copy = object.__new__(type(self))
        for field in fields:
            object.__setattr__(copy, field, getattr(self, field))
        copy._set(values)
        copy.check()
        return copy

    def check(self) -> None:
        """Raise `ParameterError` if keys contradict each other."""
