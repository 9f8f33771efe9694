"""Rules of motion by names of sets, and what they mean for the nodes of a mesh."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field, fields, replace
from typing import Any

import numpy as np

from hexmend.errors import ParameterError

#: Choices for the interfaces between materials: kept like the boundary, sliding on themselves, or free.
INTERFACES = ("keep", "slide", "free")
#: Rules of single sets.
_SETS = ("fix", "slide", "free", "plane")


@dataclass(frozen=True)
class MotionRules:
    """Rules of motion of a run, by names of sets.

    Parameters
    ----------
    interfaces : str
        keep: nodes between materials are fixed where the boundary is fixed, and slide on the interface where it slides;
        slide: they slide on the interface in any case; free: they move as if there were one material.
    fix, slide, free, plane : tuple of str
        Names of sets whose nodes stay; slide on the surface; are no longer pinned or kept on an interface; and move in
        the plane in which they lie.
    periodic : tuple of (str, str)
        Pairs of sets of faces that move as one.

    Raises
    ------
    ParameterError
        For another choice of `interfaces`, and for names that are no texts.
    """

    interfaces: str = "keep"
    fix: tuple[str, ...] = ()
    slide: tuple[str, ...] = ()
    free: tuple[str, ...] = ()
    plane: tuple[str, ...] = ()
    periodic: tuple[tuple[str, str], ...] = ()

    def __post_init__(self) -> None:
        if self.interfaces not in INTERFACES:
            raise ParameterError(f"interfaces = {self.interfaces!r}: expected one of {', '.join(INTERFACES)}")
        for name in _SETS:
            object.__setattr__(self, name, _names(name, getattr(self, name)))
        pairs = self.periodic
        if not isinstance(pairs, tuple | list) or any(len(_names("periodic", pair)) != 2 for pair in pairs):
            raise ParameterError(f"periodic = {pairs!r}: expected pairs of names of sets")
        object.__setattr__(self, "periodic", tuple(_names("periodic", pair) for pair in pairs))

    def __bool__(self) -> bool:
        return self != MotionRules()

    def values(self) -> dict[str, Any]:
        """Return the rules that are not at their defaults as data for TOML and JSON."""
        answer = {}
        for one in fields(self):
            value = getattr(self, one.name)
            if value != one.default:
                names = [list(name) if isinstance(name, tuple) else name for name in value]
                answer[one.name] = value if isinstance(value, str) else names
        return answer

    def merge(self, other: MotionRules) -> MotionRules:
        """Return both together; the choice for interfaces is that of `other` unless it is the default."""
        names = [one.name for one in fields(self) if one.name != "interfaces"]
        sets = {name: tuple(dict.fromkeys(getattr(self, name) + getattr(other, name))) for name in names}
        chosen = self.interfaces if other.interfaces == "keep" else other.interfaces
        return replace(self, interfaces=chosen, **sets)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of all sets that have a rule, each once."""
        several = (*self.fix, *self.slide, *self.free, *self.plane, *(name for pair in self.periodic for name in pair))
        return tuple(dict.fromkeys(several))

    def limited_to(self, names: Collection[str]) -> MotionRules:
        """Return the rules of the sets of these names alone, and the choice for interfaces."""
        sets: dict[str, Any] = {key: tuple(name for name in getattr(self, key) if name in names) for key in _SETS}
        pairs = tuple(pair for pair in self.periodic if set(pair) <= set(names))
        return replace(self, periodic=pairs, **sets)

    def with_renamed(self, name: str, new: str) -> MotionRules:
        """Return the rules for a mesh with a renamed set.

        >>> MotionRules(fix=("a", "b"), periodic=(("a", "c"),)).with_renamed("a", "new").values()
        {'fix': ['new', 'b'], 'periodic': [['new', 'c']]}
        """

        def renamed(names: tuple[str, ...]) -> tuple[str, ...]:
            return tuple(new if one == name else one for one in names)

        sets: dict[str, Any] = {key: renamed(getattr(self, key)) for key in _SETS}
        sets["periodic"] = tuple(renamed(pair) for pair in self.periodic)
        return replace(self, **sets)

    @classmethod
    def from_values(cls, data: Mapping[str, Any]) -> MotionRules:
        """Make the rules of data as of `values`; raises `ParameterError` for an unknown key or another type."""
        known = [one.name for one in fields(cls)]
        for key in data:
            if key not in known:
                raise ParameterError(f"there is no rule {key!r}: expected one of {', '.join(known)}")
        return cls(**data)


@dataclass(frozen=True, eq=False)
class NodeRules:
    """Rules of motion of the nodes of one mesh.

    Parameters
    ----------
    rules : MotionRules
        The rules by names.
    fixed : (n,) bool, optional
        Nodes that stay whatever slides.
    free : (n,) bool, optional
        Nodes that neither pins nor interfaces keep.
    slides : (n,) bool, optional
        Nodes that slide on the surface even if the boundary is fixed.
    """

    rules: MotionRules = field(default_factory=MotionRules)
    fixed: np.ndarray | None = None
    free: np.ndarray | None = None
    slides: np.ndarray | None = None

    @property
    def interfaces(self) -> str:
        """Choice for the interfaces; see `MotionRules`."""
        return self.rules.interfaces


def _names(rule: str, value: object) -> tuple[str, ...]:
    """Return one name or several as a tuple."""
    names = (value,) if isinstance(value, str) else value
    if not isinstance(names, tuple | list) or not all(isinstance(name, str) for name in names):
        raise ParameterError(f"{rule} = {value!r}: expected names of sets")
    return tuple(names)
