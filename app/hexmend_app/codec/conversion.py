"""Tables of keys, and conversion of dataclasses to plain data and back, for scenes and sessions.

Tables of scenes and other dataclasses become dicts of their keys, enumerations their values, tuples and frozensets
lists. msgspec checks types and bounds. Errors name the place of a value, such as `[bar] ticks`, and what is expected.
"""

from __future__ import annotations

import dataclasses
import re
import typing
from collections.abc import Callable, Mapping
from enum import Enum
from functools import cache
from types import NoneType, UnionType
from typing import Any

import msgspec

from hexmend.errors import HexmendError, ParameterError
from hexmend.parameters import Parametrised, from_values
from hexmend.toml_text import parse_toml
from hexmend_app.codec.option import Option, in_words, options_of

#: Place of a value: names of tables, numbers of entries and the key, outermost first.
KeyPath = tuple[str | int, ...]
#: Functions that convert values of some types.
Hooks = Mapping[type, Callable[[Any], Any]]


class DecodeError(ParameterError):
    """Invalid value of a key, with its place."""


def encode(value: Any, hooks: Hooks | None = None) -> Any:
    """Return a value as plain data, without empty keys.

    Parameters
    ----------
    value
    hooks : mapping of type to callable, optional
        Returns the data of a value of the type, or of a subclass.
    """
    for hooked, hook in (hooks or {}).items():
        if isinstance(value, hooked):
            return hook(value)
    if isinstance(value, Enum):
        return value.value
    if isinstance(value, Parametrised):
        return value.values()
    kind: Any = type(value)
    if dataclasses.is_dataclass(value):
        values = vars(value)
        return {o.name: encode(values[o.field], hooks) for o in options_of(kind) if not _is_default(values[o.field], o)}
    if isinstance(value, Mapping):
        return {name: encode(entry, hooks) for name, entry in value.items()}
    if isinstance(value, tuple | list | frozenset):
        entries = sorted(value) if isinstance(value, frozenset) else list(value)
        return entries if {int, float}.issuperset(map(type, entries)) else [encode(entry, hooks) for entry in entries]
    return value


def _is_default(value: Any, option: Option) -> bool:
    """Return True if a value is empty and the default."""
    is_empty = value is None or (isinstance(value, str | tuple | dict | frozenset) and not value)
    return is_empty and value == option.default


def decode(kind: Any, data: Any, where: KeyPath = (), hooks: Hooks | None = None) -> Any:
    """Return a value of a type from plain data; missing keys have their defaults.

    Parameters
    ----------
    kind : type
        A dataclass, or a type made of dataclasses and plain types.
    data
        Data as returned by a parser of TOML or JSON.
    where : tuple
        Place in the file; empty for the whole file.
    hooks : mapping of type to callable, optional
        Returns the value of the type from data.

    Raises
    ------
    DecodeError
    """
    return _Decoder(hooks or {}).value(Option("", "", kind, None, bounded=False), data, where)


def decode_key(option: Option, data: Any) -> Any:
    """Return the value of a key of a table from plain data, or from a value of its type.

    Raises
    ------
    DecodeError
    """
    return _Decoder({}).value(option, data, (option.name,))


class _Decoder:
    """Recursion through dataclasses; everything else is converted by msgspec."""

    def __init__(self, hooks: Hooks):
        self._hooks, self._hooked = hooks, frozenset(hooks)

    def value(self, option: Option, data: Any, where: KeyPath) -> Any:
        """Return a value of the type of an option."""
        kinds = [kind for kind in _alternatives(option.kind) if _has_tables(kind, self._hooked)]
        if not kinds:
            return _checked(option, data, where)
        (kind,) = kinds
        if data is None and kind is not option.kind:
            return None
        if kind in self._hooks:
            return self._convert(kind, data, where)
        if dataclasses.is_dataclass(kind):
            return self._table(kind, data, where)
        origin, inner = typing.get_origin(kind), typing.get_args(kind)
        if origin in (dict, Mapping):
            table = _checked(option._replace(kind=dict[str, Any]), data, where)
            each, names = option._replace(kind=inner[1]), option._replace(kind=str, most=None)
            places = {name: (".".join(map(str, (*where, name))),) for name in table}
            return {_checked(names, name, where): self.value(each, table[name], places[name]) for name in table}
        is_fixed = origin is tuple and inner[-1] is not Ellipsis
        form = tuple[(Any,) * len(inner)] if is_fixed else tuple[Any, ...]  # type: ignore[misc]
        entries = _checked(option._replace(kind=form), data, where)
        types = inner if is_fixed else (inner[0],) * len(entries)
        pairs = enumerate(zip(types, entries, strict=True), 1)
        return origin(self.value(option._replace(kind=of, most=None), one, (*where, at)) for at, (of, one) in pairs)

    def _convert(self, kind: type, data: Any, where: KeyPath) -> Any:
        try:
            return self._hooks[kind](data)
        except (HexmendError, ValueError, TypeError, KeyError, IndexError, OverflowError) as error:
            raise DecodeError(f"{place_of(where)}: {error}") from None

    def _table(self, kind: Any, data: Any, where: KeyPath) -> Any:
        if isinstance(data, kind):
            return data
        if not isinstance(data, dict):
            raise DecodeError(f"{place_of(where)} is not a table: expected keys and values")
        known = {option.name: option for option in options_of(kind)}
        for name in data:
            if name not in known:
                raise DecodeError(
                    f"{place_of(where)} has an unknown key {str(name)[:80]!r}: expected {', '.join(known)}"
                )
        if missing := [name for name, one in known.items() if one.default is dataclasses.MISSING and name not in data]:
            raise DecodeError(f"{place_of(where)} has no key {missing[0]!r}")
        try:
            if issubclass(kind, Parametrised):
                return from_values(kind, data)
            values = {known[name].field: self.value(known[name], one, (*where, name)) for name, one in data.items()}
            return kind(**values)
        except DecodeError:
            raise
        except (HexmendError, ValueError) as error:
            raise DecodeError(f"{place_of(where)}: {error}") from None


def _checked(option: Option, value: Any, where: KeyPath) -> Any:
    """Return a value as the type of an option, within its bounds.

    Raises
    ------
    DecodeError
    """
    if option.kind is Any:
        return value
    try:
        return msgspec.convert(value, _schema(option._replace(default=None)))
    except msgspec.ValidationError as error:
        converted = _without_numpy(value)
        if converted is not value:
            return _checked(option, converted, where)
        raise DecodeError(_sentence(option, value, where, str(error))) from None


_schema = cache(Option.schema)


def _without_numpy(value: Any) -> Any:
    """Return a value with numbers of Python instead of NumPy's; the value itself if it has none."""
    if isinstance(value, tuple | list):
        entries = [_without_numpy(entry) for entry in value]
        return value if all(a is b for a, b in zip(entries, value, strict=True)) else entries
    return value.item() if hasattr(value, "item") and not getattr(value, "ndim", 0) else value


def _sentence(option: Option, value: Any, where: KeyPath, error: str) -> str:
    """Return an error of msgspec in words."""
    kinds = _alternatives(option.kind)
    for at in re.findall(r"\[([^]]+)\]", error.partition(" - at `$")[2]):
        inner = typing.get_args(kinds[-1])
        if at.isdigit():  # of a list; the keys of a table are not given
            value = list(value)[int(at)]
        kinds = (inner[0] if at.isdigit() else inner[-1],)
    place = place_of(where) if len(where) != 1 else str(where[0])  # a key of a table that is not known yet
    words = " or ".join(map(in_words, kinds))
    if "of length" in error and not isinstance(value, str):
        count = len(typing.get_args(kinds[-1])) if option.most is None else option.most
        problem, words = f"has {len(value)} entries", str(count)
    elif isinstance(value, str) and str in kinds:
        problem, words = "is not a line of text", f"{option.most or 200} characters at most"
    elif ">=" in error or "<=" in error or "out of range" in error:
        problem, words = "is out of range", words + option.bounds
    elif words.startswith("one of "):
        problem, words = "is unknown", words.removeprefix("one of ")
    else:
        problem, words = f"is not {words}", words.replace("a boolean", "true or false")
        words += " such as [1, 2]" if words == "a list" else option.bounds
    return f"{place} = {_repr_of(value)} {problem}: expected {words}"


def _alternatives(kind: Any) -> tuple[Any, ...]:
    """Return the types of a union without NoneType, or the type itself."""
    is_union = typing.get_origin(kind) in (UnionType, typing.Union)
    return tuple(one for one in typing.get_args(kind) if one is not NoneType) if is_union else (kind,)


@cache
def _has_tables(kind: Any, hooked: frozenset[type]) -> bool:
    """Return True if a type is one with a hook, a dataclass, or has entries of such types."""
    is_table = kind in hooked or dataclasses.is_dataclass(kind)
    return is_table or any(_has_tables(one, hooked) for one in typing.get_args(kind))


def place_of(path: KeyPath) -> str:
    """Return a place as text.

    >>> place_of(("bar", "ticks")), place_of(("panels", 2, "mesh")), place_of(("cut", "planes", 1, "normal"))
    ('[bar] ticks', '[panels 2] mesh', '[cut] planes 1 normal')
    """
    if not path:
        return "the file"
    inside = 2 if len(path) > 1 and isinstance(path[1], int) else 1
    table, rest = " ".join(map(str, path[:inside])), " ".join(map(str, path[inside:]))
    return f"[{table}] {rest}".rstrip()


def _repr_of(value: Any) -> str:
    """Return the text of a value for errors."""
    if isinstance(value, int) and abs(value) > 1e300:
        return "a huge number"
    try:
        text = repr(list(value) if isinstance(value, tuple) else value)
    except RecursionError:  # deeper nesting than `repr` supports
        return "a table"
    return text if len(text) <= 60 else f"{text[:57]}..."


def option(default: Any = None, **bounds: Any) -> Any:
    """Declare a key as a field; its type is the annotation of the field, and `bounds` are fields of `Option`."""
    default_argument = "default_factory" if callable(default) else "default"
    return dataclasses.field(**{default_argument: default}, metadata={"key": bounds})


@dataclasses.dataclass(frozen=True)
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
