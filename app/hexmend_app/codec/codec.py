"""Conversion of values to plain data and back by the types of dataclass fields, for the state in session files.

Dataclasses become tables of their fields, and tables of scenes are stored as in their files; enumerations become their
values, tuples and frozensets become lists.
Decoding checks types: an error names the place of a field that is unknown, missing or of another type.
"""

from __future__ import annotations

import dataclasses
import typing
from collections.abc import Callable, Mapping
from enum import Enum
from functools import cache
from typing import Any, NamedTuple

from hexmend.errors import HexmendError
from hexmend.parameters import Parametrised, declared
from hexmend_app.codec import config_table
from hexmend_app.codec.config_table import ConfigTable
from hexmend_app.codec.conversion import Conversion, are_integers, entry_types, fixed_length


class DecodeError(HexmendError):
    """Data that is not of the declared type."""


class TypeAdapter(NamedTuple):
    """Conversion of a type to plain data (`data`) and back (`value`); invalid data raise."""

    data: Callable[[Any], Any]
    value: Callable[[Any], Any]


class Codec(Conversion):
    """Converter of values to plain data and back.

    Parameters
    ----------
    adapters : mapping of type to TypeAdapter
        Types with a special conversion.

    Examples
    --------
    >>> from hexmend_app.picture.appearance import Traces
    >>> codec = Codec({})
    >>> codec.encode(Traces(), Traces)["since"]
    'opened'
    >>> codec.decode(codec.encode(Traces(), Traces), Traces) == Traces()
    True
    >>> codec.decode({"factor": 3}, Traces, "movement")
    Traceback (most recent call last):
    hexmend_app.codec.codec.DecodeError: movement has no field 'since'
    """

    def __init__(self, adapters: Mapping[type, TypeAdapter]):
        self._adapters = adapters

    def encode(self, value: Any, kind: Any) -> Any:
        """Return a value of a declared type as plain data."""
        return self._adapters[kind].data(value) if kind in self._adapters else super().encode(value, kind)

    def decode(self, data: Any, kind: Any, where: str = "it") -> Any:
        """Return the value of a declared type from plain data.

        Parameters
        ----------
        data
        kind : type
        where : str
            Name of the data in errors.

        Raises
        ------
        DecodeError
        """
        try:
            return self._adapters[kind].value(data) if kind in self._adapters else super().decode(data, kind, where)
        except DecodeError:
            raise
        except (HexmendError, ValueError, TypeError, KeyError, IndexError, OverflowError) as error:
            raise DecodeError(f"{where}: {error}") from None

    def _encode_union(self, value: Any, kinds: tuple[Any, ...]) -> Any:
        if len(kinds) == 1:
            return self.encode(value, kinds[0])
        return {type(value).__name__: self.encode(value, type(value))}

    def _encode_table(self, value: Any, kind: Any) -> dict[str, Any]:
        if issubclass(kind, ConfigTable):
            return config_table.encode(value)
        return {name: self.encode(getattr(value, name), field_kind) for name, field_kind in _fields(kind).items()}

    def _decode_union(self, data: Any, kinds: tuple[Any, ...], where: str) -> Any:
        if len(kinds) == 1:
            return self.decode(data, kinds[0], where)
        _check(data, dict, where)
        named = {kind.__name__: kind for kind in kinds}
        if len(data) != 1 or next(iter(data)) not in named:
            raise DecodeError(f"{where} is none of {', '.join(named)}")
        ((name, inside),) = data.items()
        return self.decode(inside, named[name], where)

    def _decode_table(self, data: Any, kind: Any, where: str) -> Any:
        _check(data, dict, where)
        if issubclass(kind, ConfigTable):
            return config_table.decode(kind, data, (where.rpartition(".")[2],))
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

    def _decode_enum(self, data: Any, kind: type[Enum], where: str) -> Any:
        return kind(data)

    def _decode_entries(self, data: Any, kind: Any, where: str) -> list[Any]:
        _check(data, list, where)
        count = fixed_length(kind)
        if count not in (None, len(data)):
            raise DecodeError(f"{where} has {len(data)} entries: expected {count}")
        if are_integers(data, kind):
            return data
        kinds = entry_types(kind, len(data))
        entries = zip(data, kinds, strict=True)
        return [self.decode(entry, entry_kind, f"{where}[{at}]") for at, (entry, entry_kind) in enumerate(entries)]

    def _decode_mapping(self, data: Any, kind: Any, where: str) -> dict[str, Any]:
        _check(data, dict, where)
        return {name: self.decode(value, kind, f"{where}.{name}") for name, value in data.items()}

    def _decode_plain(self, data: Any, kind: type, where: str) -> Any:
        if kind is float and type(data) is int:
            return float(data)
        _check(data, kind, where)
        return data


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


def _check(data: Any, kind: type, where: str) -> None:
    if not isinstance(data, kind) or (isinstance(data, bool) and kind is not bool):
        raise DecodeError(f"{where} is of another type: expected {kind.__name__}")
