"""Declarations of the keys of tables: types, defaults and bounds."""

from __future__ import annotations

import dataclasses
import typing
from enum import Enum
from functools import cache
from types import NoneType, UnionType
from typing import Annotated, Any, NamedTuple

from msgspec import Meta

#: Maximum number of letters of a line of text, and maximum absolute value of a number.
_LONGEST, _MAX_NUMBER = 200, 1e300
#: Letters of a line of text: no control characters and ends of lines.
_LETTERS = r"[^\x00-\x1f\x7f-\x9f\u2028\u2029]"


class Option(NamedTuple):
    """Declaration of a key of a table.

    `name` is the name in files, and `field` the name in the dataclass. `low` and `high` bound a number, or each
    number of a list; `most` is the maximum number of entries of a list or of letters of a text; `open_ended` admits
    infinity. `offered` are the texts that the window suggests, `titles` those of the members of an enumeration. A
    dataclass that is not a table has no bounds: `bounded` is False.
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
    titles: tuple[str, ...] = ()
    bounded: bool = True

    @property
    def bounds(self) -> str:
        """Text of the bounds and the unit, to follow "a number"; "" without bounds and unit."""
        ends = [f"{end:,.10g}" for end in (self.low, self.high) if end is not None]
        bounds = {0: "", 1: f" from {ends[0] if ends else 0} up", 2: " from " + " to ".join(ends)}[len(ends)]
        return f"{bounds} {self.unit}".rstrip()

    def schema(self, kind: Any = None) -> Any:
        """Return a type, by default that of the key, with the bounds, for msgspec."""
        kind = self.kind if kind is None else kind
        origin, inner = typing.get_origin(kind), typing.get_args(kind)
        if not self.bounded:
            return kind
        if origin in (UnionType, typing.Union):
            return typing.Union[tuple(map(self.schema, inner))]  # noqa: UP007  # of a number of types known here alone
        if origin in (tuple, frozenset):
            inside = self._replace(most=None)
            entries = origin[tuple(one if one is Ellipsis else inside.schema(one) for one in inner)]
            is_fixed = origin is tuple and inner[-1] is not Ellipsis
            return entries if is_fixed or self.most is None else Annotated[entries, Meta(max_length=self.most)]
        if origin is dict and self.most is not None:
            return Annotated[kind, Meta(max_length=self.most)]
        if kind is str:
            # Not by `max_length`, with which msgspec 0.23 crashes in unions with a list of fixed length.
            return Annotated[str, Meta(pattern=rf"\A{_LETTERS}{{0,{self.most or _LONGEST}}}\Z")]
        if kind is int and (self.low, self.high) != (None, None):
            return Annotated[int, Meta(ge=self.low, le=self.high)]
        if kind is float and not self.open_ended:
            low, high = -_MAX_NUMBER if self.low is None else self.low, _MAX_NUMBER if self.high is None else self.high
            return Annotated[float, Meta(ge=low, le=high)]
        return kind


#: Types in words.
_WORDS = {bool: "a boolean", int: "a whole number", float: "a number", str: "a text", NoneType: "nothing"}


def in_words(kind: Any) -> str:
    """Return a type in words.

    >>> in_words(int | tuple[float, ...]), in_words(dict[str, int])
    ('a whole number or a list', 'a table')
    """
    origin, inner = typing.get_origin(kind), typing.get_args(kind)
    if origin in (UnionType, typing.Union):
        return " or ".join(in_words(one) for one in inner if one is not NoneType)
    if isinstance(kind, type) and issubclass(kind, Enum):
        return f"one of {', '.join(kind)}"
    if getattr(kind, "__name__", "") == "ndarray":
        return "an array"
    return "a list" if origin in (tuple, list, frozenset) else _WORDS.get(kind, "a table")


@cache
def options_of(kind: Any) -> tuple[Option, ...]:
    """Return the declarations of the keys of a table or another dataclass, which are its fields, in order."""
    types = typing.get_type_hints(kind)
    return tuple(
        Option(
            field.name.rstrip("_"),
            field.name,
            types[field.name],
            _default(field),
            **field.metadata.get("key", {"bounded": False}),
        )
        for field in dataclasses.fields(kind)
        if field.init
    )


def _default(field: dataclasses.Field) -> Any:
    return field.default if field.default_factory is dataclasses.MISSING else field.default_factory()
