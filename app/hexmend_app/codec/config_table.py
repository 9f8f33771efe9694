"""Tables of keys with defaults and bounds: what a scene is made of, and how data of a file becomes one of them.

A table is a frozen dataclass; what a key means stands in its docstring, and its bounds in its field. `made` reads one
from plain data, and `plain` gives its data; what is not admitted is named with its place, such as `[bar] ticks`.
"""

from __future__ import annotations

import dataclasses
import math
import typing
from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from functools import cache
from types import NoneType, UnionType
from typing import Any, NamedTuple

from hexmend.errors import ParameterError

#: Letters of a text, and the largest number.
LONGEST, _FARTHEST = 200, 1e300


class Option(NamedTuple):
    """A key of a table as it is declared.

    `name` is as a file writes it and `field` as the dataclass does; bounds are of its number, or of each number of a
    list, which has `most` entries at most, or of a text that many letters; `open_ended` admits infinity.
    Of any text, some are `offered`.
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
        """The bounds as they stand after a number in words; "" for none."""
        ends = [f"{end:,.10g}" for end in (self.low, self.high) if end is not None]
        between = {0: "", 1: f" from {ends[0] if ends else 0} up", 2: " from " + " to ".join(ends)}[len(ends)]
        return f"{between} {self.unit}".rstrip()


def option(default: Any = None, **bounds: Any) -> Any:
    """Declare a key; its type is the field's annotation, and its bounds are those of `Key`."""
    made = {"default_factory": default} if callable(default) else {"default": default}
    return dataclasses.field(**made, metadata={"key": bounds})


@cache
def options_of(kind: type) -> tuple[Option, ...]:
    """The keys of a table, or of another dataclass, in order."""
    types = typing.get_type_hints(kind)
    return tuple(
        Option(one.name.rstrip("_"), one.name, types[one.name], _default(one), **one.metadata.get("key", {}))
        for one in dataclasses.fields(kind)
    )


def _default(field: dataclasses.Field) -> Any:
    return field.default if field.default_factory is dataclasses.MISSING else field.default_factory()


#: Where a value stands: the names of tables, numbers of entries and the key, from the outside.
Path = tuple[str | int, ...]


class OptionError(ParameterError):
    """Invalid entry of a table, with its place."""

    @classmethod
    def of(cls, where: Path, value: Any, problem: str) -> OptionError:
        """The error for a value: of a key alone, the table is not known yet."""
        place = str(where[0]) if len(where) == 1 else _place(where)
        return cls(" ".join((place, "=", _shown(value), problem)))


@dataclass(frozen=True)
class ConfigTable:
    """Base of tables: the values are checked, and brought into their types, as they are made.

    Raises
    ------
    ParameterError
        Naming the key, its value and what was expected.
    """

    def __post_init__(self) -> None:
        for one in options_of(type(self)):
            object.__setattr__(self, one.field, _taken(getattr(self, one.field), one.kind, one, (one.name,)))
        self.check()

    def check(self) -> None:
        """Raise `ParameterError` where keys do not go together."""


def decode(kind: type, data: Any, where: Path = ()) -> Any:
    """The table of a kind that plain data stands for.

    Parameters
    ----------
    kind : type
        A dataclass.
    data
        As a parser of TOML gives it.
    where : tuple
        Where it stands in the file; nothing is the whole of it.

    Raises
    ------
    Misplaced
    """
    table = _place(where)
    if not isinstance(data, dict):
        raise OptionError(f"{table} is no table: expected keys and values")
    known = {one.name: one for one in options_of(kind)}
    for name in data:
        if name not in known:
            raise OptionError(f"{table} has an unknown key {str(name)[:80]!r}: expected {', '.join(known)}")
    values = {
        known[name].field: _taken(one, known[name].kind, known[name], (*where, name)) for name, one in data.items()
    }
    try:
        return kind(**values)
    except OptionError as error:
        raise OptionError(f"{table}: {error}" if where else str(error)) from None
    except (ParameterError, ValueError) as error:
        raise OptionError(f"{table}: {error}") from None


def encode(table: Any) -> dict[str, Any]:
    """A table as plain data: every key that has a value."""
    values = {one.name: getattr(table, one.field) for one in options_of(type(table))}
    return {name: _data(value) for name, value in values.items() if value not in (None, "", (), {})}


def _data(value: Any) -> Any:
    if isinstance(value, StrEnum):
        return value.value
    if dataclasses.is_dataclass(value):
        return encode(value)
    if isinstance(value, tuple):
        return [_data(one) for one in value]
    if isinstance(value, Mapping):
        return {name: _data(one) for name, one in value.items()}
    return value


def _place(where: Path) -> str:
    """A place in words.

    >>> _place(()), _place(("bar", "ticks")), _place(("panels", 2, "mesh")), _place(("cut", "planes", 1, "normal"))
    ('the scene', '[bar] ticks', '[panels 2] mesh', '[cut] planes 1 normal')
    """
    if not where:
        return "the scene"
    inside = 2 if len(where) > 1 and isinstance(where[1], int) else 1
    table, rest = " ".join(map(str, where[:inside])), " ".join(map(str, where[inside:]))
    return f"[{table}] {rest}".rstrip()


def _taken(value: Any, kind: Any, one: Option, where: Path) -> Any:
    """A value brought into its type, once it is known to be of it."""
    origin, inner = typing.get_origin(kind), typing.get_args(kind)
    if origin in (UnionType, typing.Union):
        return _one_of(value, inner, one, where)
    if dataclasses.is_dataclass(kind):
        return value if isinstance(value, kind) else decode(kind, value, where)
    if origin is tuple:
        return _several(value, inner, one, where)
    if origin is dict:
        return _named(value, inner[1], one, where)
    if kind is bool:
        if not isinstance(value, bool):
            raise OptionError.of(where, value, "is no switch: expected true or false")
        return value
    if issubclass(kind, StrEnum):
        if value not in list(kind):
            raise OptionError.of(where, value, f"is unknown: expected {', '.join(kind)}")
        return kind(value)
    return _text(value, where, one.most or LONGEST) if kind is str else _number(value, kind, one, where)


def _one_of(value: Any, kinds: tuple[Any, ...], one: Option, where: Path) -> Any:
    """A value of the first of several types that has its shape."""
    if value is None and NoneType in kinds:
        return None
    kinds = tuple(kind for kind in kinds if kind is not NoneType)
    for kind in kinds[:-1]:
        shape = (list, tuple) if typing.get_origin(kind) is tuple else str if issubclass(kind, str) else int | float
        if isinstance(value, shape) and not isinstance(value, bool):
            return _taken(value, kind, one, where)
    return _taken(value, kinds[-1], one, where)


def _several(value: Any, inner: tuple[Any, ...], one: Option, where: Path) -> tuple:
    if not isinstance(value, list | tuple):
        raise OptionError.of(where, value, "is no list: expected one such as [1, 2]")
    most = len(inner) if inner[-1:] != (Ellipsis,) else one.most
    if most is not None and (len(value) > most or (len(value) < most and inner[-1:] != (Ellipsis,))):
        raise OptionError.of(where, value, f"has {len(value)} entries: expected {most}")
    tables = dataclasses.is_dataclass(inner[0])
    return tuple(
        _taken(entry, inner[0], one, (*where, number) if tables else where) for number, entry in enumerate(value, 1)
    )


def _named(value: Any, kind: type, one: Option, where: Path) -> dict[str, Any]:
    if not isinstance(value, dict):
        raise OptionError.of(where, value, "is no table: expected one of tables by name")
    if one.most is not None and len(value) > one.most:
        raise OptionError.of(where, value, f"has {len(value)} entries: expected {one.most}")
    outside = ".".join(map(str, where))
    return {_text(name, where): _taken(entry, kind, one, (f"{outside}.{name}",)) for name, entry in value.items()}


def _text(value: Any, where: Path, longest: int = LONGEST) -> str:
    if not isinstance(value, str):
        raise OptionError.of(where, value, "is no text: expected one in quotes")
    if len(value) > longest or not value.isprintable():
        raise OptionError.of(where, value, f"is no text of a line: expected {longest} letters at most")
    return value


def _number(value: Any, kind: type, one: Option, where: Path) -> float:
    whole = kind is int
    expected = f"{'a whole number' if whole else 'a number'}{one.bounds}"
    if isinstance(value, bool) or not isinstance(value, int if whole else int | float):
        raise OptionError.of(where, value, f"is no {'whole ' * whole}number: expected {expected}")
    low, high = -math.inf if one.low is None else one.low, math.inf if one.high is None else one.high
    # Written so that nan is refused too. Whole numbers in a file may have more digits than a float can.
    if not low <= value <= high or not (one.open_ended or abs(value) <= _FARTHEST):
        raise OptionError.of(where, value, f"is out of range: expected {expected}")
    return kind(value)


def _shown(value: Any) -> str:
    """A value as it stands in an error."""
    if isinstance(value, int) and abs(value) > _FARTHEST:
        return "a huge number"
    try:
        text = repr(list(value) if isinstance(value, tuple) else value)
    except RecursionError:  # tables in tables, which a parser takes deeper than that
        return "a table"
    return text if len(text) <= 60 else f"{text[:57]}..."
