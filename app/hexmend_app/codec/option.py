"""Declarations of the keys of tables: types, defaults and bounds."""

from __future__ import annotations

import dataclasses
import typing
from functools import cache
from typing import Any, NamedTuple


class Option(NamedTuple):
    """Declaration of a key of a table.

    `name` is the name in files, and `field` the name in the dataclass. `low` and `high` bound a number, or each number
    of a list; `most` is the maximum number of entries of a list or of letters of a text; `open_ended` admits infinity.
    `offered` are the texts that the window suggests.
    """

    name: str
    field: str
    kind: Any
    default: Any
    low: float | None = None
    high: float | None = None
    most: int | None = None
    unit: str = ""
    open_ended: bool = False
    offered: tuple[str, ...] = ()

    @property
    def bounds(self) -> str:
        """Text of the bounds and the unit, to follow "a number"; "" without bounds and unit."""
        ends = [f"{end:,.10g}" for end in (self.low, self.high) if end is not None]
        bounds = {0: "", 1: f" from {ends[0] if ends else 0} up", 2: " from " + " to ".join(ends)}[len(ends)]
        return f"{bounds} {self.unit}".rstrip()


def option(default: Any = None, **bounds: Any) -> Any:
    """Declare a key as a field; its type is the annotation of the field, and `bounds` are fields of `Option`."""
    default_argument = "default_factory" if callable(default) else "default"
    return dataclasses.field(**{default_argument: default}, metadata={"key": bounds})


@cache
def options_of(kind: Any) -> tuple[Option, ...]:
    """Return the declarations of the keys of a table or another dataclass, in order.

    They are its fields, unless it has a method `keys` that declares others, which `to_keys` and `from_keys` convert.
    """
    if hasattr(kind, "from_keys"):
        return kind.keys()
    types = typing.get_type_hints(kind)
    return tuple(
        Option(field.name.rstrip("_"), field.name, types[field.name], _default(field), **field.metadata.get("key", {}))
        for field in dataclasses.fields(kind)
    )


def _default(field: dataclasses.Field) -> Any:
    return field.default if field.default_factory is dataclasses.MISSING else field.default_factory()
