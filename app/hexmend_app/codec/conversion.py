"""Conversion of values to plain data and back, by their declared types."""

from __future__ import annotations

import dataclasses
import typing
from collections.abc import Collection, Mapping
from enum import Enum
from functools import cache
from types import NoneType, UnionType
from typing import Any

from hexmend.errors import HexmendError
from hexmend.parameters import Parametrised, declared

#: Types of sequences; data of all of them are lists.
_SEQUENCES = (tuple, list, frozenset)


class DecodeError(HexmendError):
    """Data that is not of the declared type."""


class Conversion:
    """Recursive conversion along a declared type; `where` is the place of a value in errors."""

    def encode(self, value: Any, kind: Any) -> Any:
        """Return a value of a declared type as plain data."""
        origin, inner = typing.get_origin(kind), typing.get_args(kind)
        if value is None or kind is Any:
            return value
        if origin in (UnionType, typing.Union):
            return self._encode_union(value, _alternatives(inner))
        if dataclasses.is_dataclass(kind):
            return self._encode_table(value, kind)
        if isinstance(value, Enum):
            return value.value
        if origin in _SEQUENCES:
            ordered = sorted(value) if origin is frozenset else value
            if are_integers(value, kind):
                return list(ordered)
            return [self.encode(*entry) for entry in zip(ordered, entry_types(kind, len(value)), strict=True)]
        if origin in (dict, Mapping):
            return {name: self.encode(entry, inner[1]) for name, entry in value.items()}
        return value

    def decode(self, data: Any, kind: Any, where: Any) -> Any:
        """Return the value of a declared type from plain data."""
        origin, inner = typing.get_origin(kind), typing.get_args(kind)
        if kind is Any:
            return data
        if origin in (UnionType, typing.Union):
            alternatives = _alternatives(inner)
            if data is None and len(alternatives) < len(inner):
                return None
            return self._decode_union(data, alternatives, where)
        if dataclasses.is_dataclass(kind):
            return self._decode_table(data, kind, where)
        if isinstance(kind, type) and issubclass(kind, Enum):
            return self._decode_enum(data, kind, where)
        if origin in _SEQUENCES:
            return origin(self._decode_entries(data, kind, where))
        if origin in (dict, Mapping):
            return self._decode_mapping(data, inner[1], where)
        return self._decode_plain(data, kind, where)

    def _encode_union(self, value: Any, kinds: tuple[Any, ...]) -> Any:
        if len(kinds) == 1:
            return self.encode(value, kinds[0])
        return {type(value).__name__: self.encode(value, type(value))}

    def _encode_table(self, value: Any, kind: Any) -> dict[str, Any]:
        return {name: self.encode(getattr(value, name), field_kind) for name, field_kind in _fields(kind).items()}

    def _decode_union(self, data: Any, kinds: tuple[Any, ...], where: Any) -> Any:
        if len(kinds) == 1:
            return self.decode(data, kinds[0], where)
        _check(data, dict, where)
        named = {kind.__name__: kind for kind in kinds}
        if len(data) != 1 or next(iter(data)) not in named:
            raise DecodeError(f"{where} is none of {', '.join(named)}")
        ((name, inside),) = data.items()
        return self.decode(inside, named[name], where)

    def _decode_table(self, data: Any, kind: Any, where: Any) -> Any:
        _check(data, dict, where)
        fields = _fields(kind)
        for name in [*fields, *data]:
            if (name in fields) != (name in data):
                raise DecodeError(f"{where} has {'an unknown' if name in data else 'no'} field {name[:80]!r}")
        words = _words(kind)
        values = {
            name: one if (one := data[name]) in words.get(name, ()) else self.decode(one, of_type, f"{where}.{name}")
            for name, of_type in fields.items()
        }
        return kind(**values)

    def _decode_enum(self, data: Any, kind: type[Enum], where: Any) -> Any:
        return kind(data)

    def _decode_entries(self, data: Any, kind: Any, where: Any) -> Collection[Any]:
        _check(data, list, where)
        count = fixed_length(kind)
        if count not in (None, len(data)):
            raise DecodeError(f"{where} has {len(data)} entries: expected {count}")
        if are_integers(data, kind):
            return data
        kinds = entry_types(kind, len(data))
        entries = zip(data, kinds, strict=True)
        return [self.decode(entry, entry_kind, f"{where}[{at}]") for at, (entry, entry_kind) in enumerate(entries)]

    def _decode_mapping(self, data: Any, kind: Any, where: Any) -> dict[str, Any]:
        _check(data, dict, where)
        return {name: self.decode(value, kind, f"{where}.{name}") for name, value in data.items()}

    def _decode_plain(self, data: Any, kind: type, where: Any) -> Any:
        if kind is float and type(data) is int:
            return float(data)
        _check(data, kind, where)
        return data


def _alternatives(kinds: tuple[Any, ...]) -> tuple[Any, ...]:
    """Return the types of a union without NoneType."""
    return tuple(kind for kind in kinds if kind is not NoneType)


def fixed_length(kind: Any) -> int | None:
    """Return the number of entries of a sequence type such as `tuple[float, float]`; None if it has no fixed length."""
    inner = typing.get_args(kind)
    return len(inner) if typing.get_origin(kind) is tuple and inner[-1:] != (Ellipsis,) else None


def entry_types(kind: Any, count: int) -> tuple[Any, ...]:
    """Return the declared types of the entries of a sequence type."""
    inner = typing.get_args(kind)
    return inner if fixed_length(kind) is not None else (inner[0],) * count


def are_integers(entries: Collection[Any], kind: Any) -> bool:
    """Return True if a sequence type is one of integers, and all entries are: they need no conversion one by one."""
    return {int, ...}.issuperset(typing.get_args(kind)) and {int}.issuperset(map(type, entries))


@cache
def _fields(kind: type) -> dict[str, Any]:
    """Return names and types of the fields of a dataclass."""
    types = typing.get_type_hints(kind)
    return {field.name: types[field.name] for field in dataclasses.fields(kind) if field.init}


@cache
def _words(kind: type) -> dict[str, list[str]]:
    """Return the words that parameters of a dataclass may be in place of numbers, such as auto."""
    if not issubclass(kind, Parametrised):
        return {}
    return {one.name: [word for word in (one.automatic, one.no_limit) if word] for one in declared(kind)}


def _check(data: Any, kind: type, where: Any) -> None:
    if not isinstance(data, kind) or (isinstance(data, bool) and kind is not bool):
        raise DecodeError(f"{where} is of another type: expected {kind.__name__}")
