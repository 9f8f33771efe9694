"""Values as plain data and back, by the types that dataclasses declare: what a session's file holds of the window.

Dataclasses become tables of their fields, enumerations their values, tuples and sets lists. What comes back is of the
declared types or is refused: a field that is unknown, missing, or of another kind is named with its place. A field
that was added `since` a version is none of older files, and has its default then; one that was renamed is read by its
former name too.
"""

from __future__ import annotations

import dataclasses
import typing
from collections.abc import Callable, Mapping
from enum import Enum
from functools import cache
from types import NoneType, UnionType
from typing import Any, NamedTuple

import numpy as np

from hexmend.errors import HexmendError

_SINCE = "since"


class DecodeError(HexmendError):
    """Data that is not of the declared type."""


def since(version: int) -> dict[str, int]:
    """The metadata of a dataclass's field that files have from a version on; for older ones it has its default."""
    return {_SINCE: version}


class TypeAdapter(NamedTuple):
    """Conversion of a type that is no dataclass of supported types to plain data and back; invalid values raise."""

    data: Callable[[Any], Any]
    value: Callable[[Any], Any]


class Codec:
    """Converts both ways.

    Parameters
    ----------
    own : mapping of type to Own
        Types with a way of their own, as they are declared.
    version : int, optional
        Of the file that is read; by default the newest.
    former : mapping of type to mapping of str to str, optional
        What fields of dataclasses were called in files that are read still, by their names now.

    Examples
    --------
    >>> from hexmend_app.picture.appearance import Look, Structure
    >>> codec = Codec({})
    >>> codec.encode(Structure(), Structure)["sharp"]
    False
    >>> codec.decode(codec.encode(Look(), Look), Look) == Look()
    True
    >>> codec.decode({"sharp": 3}, Structure, "structure")
    Traceback (most recent call last):
    hexmend_app.codec.codec.DecodeError: structure has no field 'irregular'
    """

    def __init__(
        self,
        own: Mapping[type, TypeAdapter],
        version: int | None = None,
        former: Mapping[type, Mapping[str, str]] | None = None,
    ):
        self._own, self._version, self._former = own, version, former or {}

    def encode(self, value: Any, kind: Any) -> Any:
        """A value of a declared type as plain data."""
        if kind in self._own:
            return self._own[kind].data(value)
        origin, inner = typing.get_origin(kind), typing.get_args(kind)
        if value is None or kind is np.ndarray:
            return value
        if origin in (UnionType, typing.Union):
            kinds = [one for one in inner if one is not NoneType]
            if len(kinds) == 1:
                return self.encode(value, kinds[0])
            return {type(value).__name__: self.encode(value, type(value))}
        if dataclasses.is_dataclass(kind):
            return {name: self.encode(getattr(value, name), one) for name, one in _fields(kind).items()}
        if isinstance(kind, type) and issubclass(kind, Enum):
            return value.value
        if origin in (tuple, list, frozenset):
            kinds = inner if origin is tuple and inner[-1:] != (Ellipsis,) else [inner[0]] * len(value)
            ordered = sorted(value) if origin is frozenset else value
            return [self.encode(one, its) for one, its in zip(ordered, kinds, strict=True)]
        if origin in (dict, Mapping):
            return {name: self.encode(one, inner[1]) for name, one in value.items()}
        return value

    def decode(self, data: Any, kind: Any, where: str = "it") -> Any:
        """The value of a declared type that plain data stands for.

        Parameters
        ----------
        data
        kind : type
        where : str
            What to call it in an error.

        Raises
        ------
        Misfit
        """
        try:
            return self._value(data, kind, where)
        except DecodeError:
            raise
        except (HexmendError, ValueError, TypeError, KeyError, IndexError, OverflowError) as error:
            raise DecodeError(f"{where}: {error}") from None

    def _value(self, data: Any, kind: Any, where: str) -> Any:
        if kind in self._own:
            return self._own[kind].value(data)
        origin, inner = typing.get_origin(kind), typing.get_args(kind)
        if kind is Any:
            return data
        if origin in (UnionType, typing.Union):
            return self._one_of(data, inner, where)
        if dataclasses.is_dataclass(kind):
            return self._made(data, kind, where)
        if isinstance(kind, type) and issubclass(kind, Enum):
            return kind(data)
        if origin in (tuple, list, frozenset):
            return origin(self._several(data, origin, inner, where))
        if origin in (dict, Mapping):
            _check(data, dict, where)
            return {name: self.decode(one, inner[1], f"{where}.{name}") for name, one in data.items()}
        if kind is float and type(data) is int:
            return float(data)
        _check(data, kind, where)
        return data

    def _one_of(self, data: Any, kinds: tuple[Any, ...], where: str) -> Any:
        if data is None and NoneType in kinds:
            return None
        kinds = tuple(one for one in kinds if one is not NoneType)
        if len(kinds) == 1:
            return self.decode(data, kinds[0], where)
        _check(data, dict, where)
        named = {one.__name__: one for one in kinds}
        if len(data) != 1 or next(iter(data)) not in named:
            raise DecodeError(f"{where} is none of {', '.join(named)}")
        ((name, inside),) = data.items()
        return self.decode(inside, named[name], where)

    def _made(self, data: Any, kind: type, where: str) -> Any:
        _check(data, dict, where)
        fields = _fields(kind, self._version)
        now = {was: name for name, was in self._former.get(kind, {}).items() if name not in data}
        data = {now.get(name, name): one for name, one in data.items()}
        for name in [*fields, *data]:
            if (name in fields) != (name in data):
                raise DecodeError(f"{where} has {'an unknown' if name in data else 'no'} field {name[:80]!r}")
        return kind(**{name: self.decode(data[name], one, f"{where}.{name}") for name, one in fields.items()})

    def _several(self, data: Any, origin: type, inner: tuple[Any, ...], where: str) -> list[Any]:
        _check(data, list, where)
        kinds = inner if origin is tuple and inner[-1:] != (Ellipsis,) else [inner[0]] * len(data)
        if len(kinds) != len(data):
            raise DecodeError(f"{where} has {len(data)} entries: expected {len(kinds)}")
        return [self.decode(one, its, f"{where}[{at}]") for at, (one, its) in enumerate(zip(data, kinds, strict=True))]


@cache
def _fields(kind: type, version: int | None = None) -> dict[str, Any]:
    """Names and types of the fields that a dataclass has in a version; by default in the newest."""
    types, own = typing.get_type_hints(kind), [one for one in dataclasses.fields(kind) if one.init]
    return {one.name: types[one.name] for one in own if version is None or one.metadata.get(_SINCE, 0) <= version}


def _check(data: Any, kind: type, where: str) -> None:
    if not isinstance(data, kind) or (isinstance(data, bool) and kind is not bool):
        raise DecodeError(f"{where} is of another kind: expected {kind.__name__}")
