"""Finds the features: every folder below `hexmend_app.features` is one."""

from __future__ import annotations

import inspect
import pkgutil
from importlib import import_module

import hexmend_app.features as folder
from hexmend_app.feature import Feature

#: What a mesh is opened and drawn by: built first, so that its picture need not wait for the others.
FIRST = ("open", "look", "camera")


def names() -> list[str]:
    """The folders."""
    return [one.name for one in pkgutil.iter_modules(folder.__path__)]


def kind_of(name: str) -> type[Feature]:
    """The class of the feature in a folder, which is imported.

    Raises
    ------
    TypeError
        Where its module `feature` declares none, or several.
    """
    module = import_module(f"{folder.__name__}.{name}.feature")
    own = [
        kind
        for _, kind in inspect.getmembers(module, inspect.isclass)
        if issubclass(kind, Feature) and kind.__module__ == module.__name__
    ]
    if len(own) != 1:
        raise TypeError(f"{module.__name__} declares {len(own)} features: expected one")
    return own[0]


def found() -> list[type[Feature]]:
    """The class of every feature, in their order."""
    return sorted(map(kind_of, names()), key=lambda kind: (kind.order, kind.__module__))


def name_of(kind: type[Feature]) -> str:
    """What a feature is called: its folder's name."""
    return kind.__module__.split(".")[-2]
