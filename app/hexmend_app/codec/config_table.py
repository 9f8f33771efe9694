"""Tables of keys with defaults and bounds, which are the parts of a scene, and their conversion from and to plain data.

A table is a frozen dataclass; its docstring explains the keys, and its fields declare their bounds. `decode` builds a
table from plain data, and `encode` returns its data; errors name the place of an invalid value, such as `[bar] ticks`.
"""

from __future__ import annotations

import dataclasses
import math
import typing
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple, Self

from hexmend.errors import ParameterError
from hexmend_app.codec.conversion import Conversion, are_integers, entry_types, fixed_length
from hexmend_app.codec.option import Option, options_of

#: Maximum number of letters of a text, and maximum absolute value of a number.
LONGEST, _MAX_NUMBER = 200, 1e300


#: Place of a value: names of tables, numbers of entries and the key, outermost first.
KeyPath = tuple[str | int, ...]


#: Values of keys that are not written.
_EMPTY: tuple[Any, ...] = (None, "", (), {}, frozenset())


class _Place(NamedTuple):
    """Place of a value and the declaration of its bounds."""

    path: KeyPath
    option: Option | None = None


class OptionError(ParameterError):
    """Invalid entry of a table, with its place."""

    @classmethod
    def of(cls, path: KeyPath, value: Any, problem: str) -> OptionError:
        """Return the error for a value; a path of one name is a key of a table that is not known yet."""
        place = str(path[0]) if len(path) == 1 else _place(path)
        return cls(" ".join((place, "=", _repr_of(value), problem)))


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
                value = _TABLES.decode(values[option.field], option.kind, _Place((option.name,), option))
                object.__setattr__(self, option.field, value)

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


def decode(kind: type, data: Any, where: KeyPath = ()) -> Any:
    """Return a table of a kind from plain data.

    Parameters
    ----------
    kind : type
        A dataclass.
    data
        Data as returned by a TOML parser.
    where : tuple
        Place in the file; empty for the whole file.

    Raises
    ------
    OptionError
    """
    return _TABLES.decode(data, kind, _Place(where))


def encode(table: Any) -> dict[str, Any]:
    """Return a table as plain data, without empty keys."""
    return _TABLES.encode(table, type(table))


class _TableConversion(Conversion):
    """Conversion of tables: bounds are checked, and missing keys have their defaults."""

    def _encode_union(self, value: Any, kinds: tuple[Any, ...]) -> Any:
        return self.encode(value, type(value) if dataclasses.is_dataclass(value) else _with_shape(value, kinds))

    def _encode_table(self, value: Any, kind: type) -> dict[str, Any]:
        values = value.to_keys() if hasattr(kind, "from_keys") else vars(value)
        options = options_of(type(value))  # type: ignore[arg-type]
        return {o.name: self.encode(values[o.field], o.kind) for o in options if values[o.field] not in _EMPTY}

    def _decode_union(self, data: Any, kinds: tuple[Any, ...], where: _Place) -> Any:
        return self.decode(data, _with_shape(data, kinds), where)

    def _decode_table(self, data: Any, kind: type, where: _Place) -> Any:
        if isinstance(data, kind):
            return data
        table = _place(where.path)
        if not isinstance(data, dict):
            raise OptionError(f"{table} is not a table: expected keys and values")
        known = {option.name: option for option in options_of(kind)}
        for name in data:
            if name not in known:
                raise OptionError(f"{table} has an unknown key {str(name)[:80]!r}: expected {', '.join(known)}")
        values = {
            known[name].field: self.decode(value, known[name].kind, _Place((*where.path, name), known[name]))
            for name, value in data.items()
        }
        try:
            return kind.from_keys(values) if hasattr(kind, "from_keys") else kind(**values)
        except OptionError as error:
            raise OptionError(f"{table}: {error}" if where.path else str(error)) from None
        except (ParameterError, ValueError) as error:
            raise OptionError(f"{table}: {error}") from None

    def _decode_enum(self, data: Any, kind: Any, where: _Place) -> Any:
        if data not in list(kind):
            raise OptionError.of(where.path, data, f"is unknown: expected {', '.join(kind)}")
        return kind(data)

    def _decode_entries(self, data: Any, kind: Any, where: _Place) -> Collection[Any]:
        if not isinstance(data, list | tuple | frozenset):
            raise OptionError.of(where.path, data, "is not a list: expected a list such as [1, 2]")
        count = fixed_length(kind)
        most = where.option.most if count is None else count
        if most is not None and (len(data) > most or (count is not None and len(data) < count)):
            raise OptionError.of(where.path, data, f"has {len(data)} entries: expected {most}")
        if count is None and are_integers(data, kind) and _within(data, where.option):
            return data
        entries = []
        for number, (entry, entry_kind) in enumerate(zip(data, entry_types(kind, len(data)), strict=True), 1):
            path = (*where.path, number) if dataclasses.is_dataclass(entry_kind) else where.path
            entries.append(self.decode(entry, entry_kind, _Place(path, where.option)))
        return entries

    def _decode_mapping(self, data: Any, kind: Any, where: _Place) -> dict[str, Any]:
        path, option = where
        if not isinstance(data, dict):
            raise OptionError.of(path, data, "is not a table: expected a table of tables by name")
        if option.most is not None and len(data) > option.most:
            raise OptionError.of(path, data, f"has {len(data)} entries: expected {option.most}")
        outside = ".".join(map(str, path))
        return {
            _text(name, path): self.decode(entry, kind, _Place((f"{outside}.{name}",), option))
            for name, entry in data.items()
        }

    def _decode_plain(self, data: Any, kind: type, where: _Place) -> Any:
        path, option = where
        if kind is bool:
            if not isinstance(data, bool):
                raise OptionError.of(path, data, "is not a boolean: expected true or false")
            return data
        return _text(data, path, option.most or LONGEST) if kind is str else _number(data, kind, option, path)


_TABLES = _TableConversion()


def _with_shape(value: Any, kinds: tuple[Any, ...]) -> Any:
    """Return the first of several types that fits a list, a text or a number; the last one if none fits."""
    for kind in kinds[:-1]:
        shape = (list, tuple) if typing.get_origin(kind) is tuple else str if issubclass(kind, str) else int | float
        if isinstance(value, shape) and not isinstance(value, bool):
            return kind
    return kinds[-1]


def _place(path: KeyPath) -> str:
    """Return a place as text.

    >>> _place(()), _place(("bar", "ticks")), _place(("panels", 2, "mesh")), _place(("cut", "planes", 1, "normal"))
    ('the scene', '[bar] ticks', '[panels 2] mesh', '[cut] planes 1 normal')
    """
    if not path:
        return "the scene"
    inside = 2 if len(path) > 1 and isinstance(path[1], int) else 1
    table, rest = " ".join(map(str, path[:inside])), " ".join(map(str, path[inside:]))
    return f"[{table}] {rest}".rstrip()


def _within(numbers: Collection[int], option: Option) -> bool:
    """Return True if all numbers are within the bounds of an option."""
    low, high = -_MAX_NUMBER if option.low is None else option.low, _MAX_NUMBER if option.high is None else option.high
    return not numbers or (low <= min(numbers) and max(numbers) <= high)


def _text(value: Any, path: KeyPath, longest: int = LONGEST) -> str:
    if not isinstance(value, str):
        raise OptionError.of(path, value, "is not a text: expected a text in quotes")
    if len(value) > longest or not value.isprintable():
        raise OptionError.of(path, value, f"is not a line of text: expected {longest} characters at most")
    return value


def _number(value: Any, kind: type, option: Option, path: KeyPath) -> float:
    whole = kind is int
    expected = f"{'a whole number' if whole else 'a number'}{option.bounds}"
    if isinstance(value, bool) or not isinstance(value, int if whole else int | float):
        raise OptionError.of(path, value, f"is not a {'whole ' * whole}number: expected {expected}")
    low, high = -math.inf if option.low is None else option.low, math.inf if option.high is None else option.high
    # This form rejects nan, too. Whole numbers in a file may exceed the range of floats.
    if not low <= value <= high or not (option.open_ended or abs(value) <= _MAX_NUMBER):
        raise OptionError.of(path, value, f"is out of range: expected {expected}")
    return kind(value)


def _repr_of(value: Any) -> str:
    """Return the text of a value for errors."""
    if isinstance(value, int) and abs(value) > _MAX_NUMBER:
        return "a huge number"
    try:
        text = repr(list(value) if isinstance(value, tuple) else value)
    except RecursionError:  # deeper nesting than `repr` supports
        return "a table"
    return text if len(text) <= 60 else f"{text[:57]}..."
