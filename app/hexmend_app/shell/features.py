"""Finds the features: every folder below `hexmend_app.features` is one."""

from __future__ import annotations

import inspect
import pkgutil
from importlib import import_module

import hexmend_app.features as folder
from hexmend_app.feature import Feature


def found() -> list[type[Feature]]:
    """The class of every feature, in their order.

    Raises
    ------
    TypeError
        Where a folder's module `feature` declares none, or several.
    """
    kinds = []
    for one in pkgutil.iter_modules(folder.__path__):
        module = import_module(f"{folder.__name__}.{one.name}.feature")
        own = [
            kind
            for _, kind in inspect.getmembers(module, inspect.isclass)
            if issubclass(kind, Feature) and kind.__module__ == module.__name__
        ]
        if len(own) != 1:
            raise TypeError(f"{module.__name__} declares {len(own)} features: expected one")
        kinds.append(own[0])
    return sorted(kinds, key=lambda kind: (kind.order, kind.__module__))


def name_of(kind: type[Feature]) -> str:
    """What a feature is called: its folder's name."""
    return kind.__module__.split(".")[-2]
