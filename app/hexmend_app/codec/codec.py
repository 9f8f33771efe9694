"""Conversion of values to plain data and back by the types of dataclass fields, for the state in session files.

Dataclasses become tables of their fields, and tables of scenes are stored as in their files; enumerations become their
values, tuples and frozensets become lists.
Decoding checks types: an error names the place of a field that is unknown, missing or of another type.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

from hexmend.errors import HexmendError
from hexmend_app.codec import config_table
from hexmend_app.codec.config_table import ConfigTable
from hexmend_app.codec.conversion import Conversion, DecodeError


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
    hexmend_app.codec.conversion.DecodeError: movement has no field 'since'
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

    def _encode_table(self, value: Any, kind: Any) -> dict[str, Any]:
        return config_table.encode(value) if issubclass(kind, ConfigTable) else super()._encode_table(value, kind)

    def _decode_table(self, data: Any, kind: Any, where: Any) -> Any:
        if issubclass(kind, ConfigTable) and isinstance(data, dict):
            return config_table.decode(kind, data, (where.rpartition(".")[2],))
        return super()._decode_table(data, kind, where)
