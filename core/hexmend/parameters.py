"""Declared parameters: forms, options of the command line, docs and tests are derived from one declaration.

A configurable thing is a frozen dataclass whose fields are made by `parameter`::

    @dataclass(frozen=True)
    class Blend(Parametrised):
        rho: float = parameter(0.5, low=0, high=1, help="share of the new position")

`declared(Blend)` lists the declarations, `from_strings(Blend, {"rho": "0.7"})` makes a `Blend` from text, and a value
out of bounds raises `ParameterError`.
"""

from __future__ import annotations

import dataclasses
import difflib
import functools
import math
import typing
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any, TypeVar

from hexmend.errors import ParameterError

T = TypeVar("T")

#: Beginning of the name of a set where the name alone is a word with another meaning.
SET = "set:"
#: Value that leaves the choice to the program.
AUTO = "auto"
#: Fields of `Parameter` that `hexmend methods --json` does not list.
_NOT_IN_JSON = (
    "type",
    "no_limit",
    "suggestions",
    "sets",
    "automatic",
    "percent_of",
    "titles",
    "advanced",
    "label",
    "zero",
)
_TRUE, _FALSE = ("true", "yes", "on", "1"), ("false", "no", "off", "0")


@dataclass(frozen=True)
class Parameter:
    """Declaration of a parameter.

    Parameters
    ----------
    name : str
    type : type
        bool, int, float or str.
    default : object
    low, high : number or None
        Bounds, inclusive.
    choices : tuple of str or None
    unit : str
    help : str
        A sentence.
    no_limit : str
        Word that stands for no limit, where the number is one; then it is a value as well.
    suggestions : tuple of str
        Values that forms offer for a text, which may be another.
    automatic : str
        Word, where a number is expected, that leaves the choice to the program; then it is a value as well.
    percent_of : str
        Name of what a number with a per cent sign is a share of, such as "0.5%"; "" where such numbers are no values.
    titles : tuple of str
        Titles of the choices in forms, in their order; empty where the choices themselves say enough.
    advanced : bool
        Forms show it on request only, as its default suits nearly all meshes.
    label : str
        Label in forms; "" for the name in words.
    zero : str
        Word that forms show for the number 0; "" for the number.
    """

    name: str
    type: type
    default: Any
    low: float | None = None
    high: float | None = None
    choices: tuple[str, ...] | None = None
    unit: str = ""
    help: str = ""
    no_limit: str = ""
    suggestions: tuple[str, ...] = ()
    sets: bool = False
    automatic: str = ""
    percent_of: str = ""
    titles: tuple[str, ...] = ()
    advanced: bool = False
    label: str = ""
    zero: str = ""

    def check(self, value: Any) -> Any:
        """Return `value` as this parameter's type, or raise `ParameterError` saying what was expected.

        >>> Parameter("rho", float, 0.5, low=0, high=1).check(2)
        Traceback (most recent call last):
        hexmend.errors.ParameterError: rho = 2 is out of range: expected a number from 0 to 1
        """
        if self.choices is not None:
            if not isinstance(value, str):
                raise self._error(_shown(value), "is unknown")
            named = value if value in self.choices else value.replace("_", "-")
            if named not in self.choices:
                near = suggestion(value, self.choices).rstrip()
                raise self._error(_shown(value), "is unknown", f"; {near}" if near else "")
            return named
        if self.type is bool:
            if not isinstance(value, bool):
                raise self._error(_shown(value), "is not a switch")
            return value
        if self.type is str:
            if self.sets and isinstance(value, list | tuple) and value and all(isinstance(name, str) for name in value):
                names = ",".join(value)
                return f"{SET}{names}" if names in self.suggestions else names
            return str(value)
        if isinstance(value, str) and value and value in (self.no_limit, self.automatic):
            return value
        if self.percent_of and isinstance(value, str) and value.strip().endswith("%"):
            return self._percent(value)
        try:
            if isinstance(value, bool | complex) or getattr(value, "ndim", None):
                raise ValueError
            number = self.type(value)
            if math.isnan(number) or number != float(value):
                raise ValueError
        except (TypeError, ValueError, OverflowError):
            raise self._error(_shown(value), f"is not {self._kind}") from None
        if self.no_limit and number == math.inf:
            return self.no_limit
        if (self.low is not None and number < self.low) or (self.high is not None and number > self.high):
            raise self._error(value, "is out of range")
        return number

    def _percent(self, value: str) -> str:
        """Return a number with a per cent sign in its shortest form."""
        try:
            number = float(value.strip()[:-1])
        except ValueError:
            raise self._error(repr(value), f"is not {self._kind}") from None
        if not 0 <= number <= 100:
            raise self._error(value, "is out of range")
        return f"{number:.12g}%"

    def _error(self, shown: object, problem: str, advice: str = "") -> ParameterError:
        return ParameterError(f"{self.name} = {shown} {problem}: expected {self.range}{advice}")

    @property
    def _kind(self) -> str:
        return "a whole number" if self.type is int else "a number"

    @property
    def range(self) -> str:
        """The admitted values in words."""
        if self.choices is not None:
            return f"one of {', '.join(self.choices)}"
        if self.type is bool:
            return "true or false"
        if self.type is str:
            other = "names of sets with commas between them" if self.sets else "another text"
            return f"{', '.join(self.suggestions)}, or {other}" if self.suggestions else "a text"
        words = self._kind
        if self.low is not None and self.high is not None:
            words += f" from {self.low:g} to {self.high:g}"
        elif self.low is not None:
            words += f" of at least {self.low:g}"
        elif self.high is not None:
            words += f" of at most {self.high:g}"
        percent = f"a percentage such as 0.5% of the {self.percent_of}" if self.percent_of else ""
        others = [other for other in (percent, self.automatic, self.no_limit) if other]
        return f"{', '.join([words, *others[:-1]])}, or {others[-1]}" if others else words

    def parse(self, text: str) -> Any:
        """Convert text, of the command line for example, to a value; raises `ParameterError` where it is none."""
        if self.type is bool:
            word = text.strip().lower()
            if word not in _TRUE + _FALSE:
                raise self._error(repr(text), "is not a switch")
            return word in _TRUE
        if self.type is int:
            try:
                return self.check(int(text))
            except ValueError:
                return self.check(text)
        return self.check(text)

    def to_json(self) -> dict[str, Any]:
        """The row of `hexmend methods --json`."""
        row = {key: value for key, value in vars(self).items() if key not in _NOT_IN_JSON}
        return row | {"choices": None if self.choices is None else list(self.choices)}


def _shown(value: object) -> str:
    """Represent a value in a message: one line, of an array the beginning."""
    return " ".join(repr(value).split())[:80]


def parameter(default: Any, **declaration: Any) -> Any:
    """Declare a dataclass field as a parameter; its type is the field's annotation, the rest as in `Parameter`."""
    return dataclasses.field(default=default, metadata={"parameter": declaration})


def declared(kind: type | Any) -> tuple[Parameter, ...]:
    """List the parameters that a `Parametrised` class, or an instance of it, declares, in order."""
    return _declared(kind if isinstance(kind, type) else type(kind))


@functools.cache  # every construction needs them
def _declared(cls: type) -> tuple[Parameter, ...]:
    types = typing.get_type_hints(cls)
    return tuple(
        Parameter(name=field.name, type=types[field.name], default=field.default, **field.metadata["parameter"])
        for field in dataclasses.fields(cls)
        if "parameter" in field.metadata
    )


@dataclass(frozen=True)
class Parametrised:
    """Base of frozen dataclasses with declared parameters, whose values are checked at construction."""

    def __post_init__(self) -> None:
        for declaration in declared(self):
            object.__setattr__(self, declaration.name, declaration.check(getattr(self, declaration.name)))

    def values(self) -> dict[str, Any]:
        """Parameter values by name."""
        return {declaration.name: getattr(self, declaration.name) for declaration in declared(self)}


def from_strings(cls: type[T], words: Mapping[str, str], owner: str = "") -> T:
    """Make `cls` from textual values, as the command line gives them.

    Parameters
    ----------
    cls : type
        A `Parametrised` class.
    words : mapping of str to str
        Values by the parameters' names, in which a dash counts as an underscore.
    owner : str
        Name of the class in messages.

    Returns
    -------
    Parametrised
        What is not named has its default.

    Raises
    ------
    ParameterError
        For a name that is not declared (the message suggests the nearest) or a value out of bounds.
    """
    return cls(**{one.name: one.parse(words[name]) for name, one in _declared_by_name(cls, words, owner).items()})


def from_values(cls: type[T], values: Mapping[str, Any], owner: str = "") -> T:
    """Make `cls` from values of their own types, as a TOML or JSON file gives them.

    Parameters, returned value and errors are those of `from_strings`.
    """
    return cls(**{one.name: one.check(values[name]) for name, one in _declared_by_name(cls, values, owner).items()})


def _declared_by_name(cls: type, names: Iterable[str], owner: str) -> dict[str, Parameter]:
    """Declarations by the names that were given."""
    declarations = {one.name: one for one in declared(cls)}
    given = {name: name.replace("-", "_") for name in names}
    for name, key in given.items():
        if key not in declarations:
            raise ParameterError(f"{owner or cls.__name__} has no parameter {name!r}: {hint(name, declarations)}")
    return {name: declarations[key] for name, key in given.items()}


def hint(name: str, known: Iterable[str]) -> str:
    """Suggestion for a name that is unknown.

    >>> hint("deltta", ["p", "delta"])
    'did you mean delta?'
    >>> hint("x", ["p", "delta"])
    'known: p, delta'
    """
    names = list(known)
    return suggestion(name, names).rstrip() or f"known: {', '.join(names) or 'none'}"


def suggestion(name: str, known: Iterable[str]) -> str:
    """Beginning of a message's list of names: "did you mean X? ", or "" where no name is near.

    >>> suggestion("inlett", ["inlet", "wall"]), suggestion("x", ["inlet"])
    ('did you mean inlet? ', '')
    >>> suggestion("base", ["BASE", "phase"])
    'did you mean BASE? '
    """
    names = {one.casefold(): one for one in known}
    near = difflib.get_close_matches(name.casefold(), names, n=1)
    return f"did you mean {names[near[0]]}? " if near else ""
