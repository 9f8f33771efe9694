"""Conversion of values to plain data and back, by their declared types."""

from __future__ import annotations

import dataclasses
import typing
from collections.abc import Collection, Mapping
from enum import Enum
from types import NoneType, UnionType
from typing import Any

#: Types of sequences; data of all of them are lists.
_SEQUENCES = (tuple, list, frozenset)


class Conversion:
    """Recursive conversion along a declared type; subclasses define the conversion of each sort of type.

    `where` is the place of a value in errors, in a form that the subclass defines.
    """

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
        raise NotImplementedError

    def _encode_table(self, value: Any, kind: Any) -> dict[str, Any]:
        raise NotImplementedError

    def _decode_union(self, data: Any, kinds: tuple[Any, ...], where: Any) -> Any:
        raise NotImplementedError

    def _decode_table(self, data: Any, kind: Any, where: Any) -> Any:
        raise NotImplementedError

    def _decode_enum(self, data: Any, kind: Any, where: Any) -> Any:
        raise NotImplementedError

    def _decode_entries(self, data: Any, kind: Any, where: Any) -> Collection[Any]:
        raise NotImplementedError

    def _decode_mapping(self, data: Any, kind: Any, where: Any) -> dict[str, Any]:
        raise NotImplementedError

    def _decode_plain(self, data: Any, kind: type, where: Any) -> Any:
        raise NotImplementedError


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
