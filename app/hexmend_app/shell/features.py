"""Finds the features: every folder below `hexmend_app.features` is one."""

from __future__ import annotations

import inspect
import pkgutil
import sys
from collections.abc import Generator, Iterable
from importlib import import_module

import hexmend_app.features as folder
from hexmend_app.feature import Feature, Host


def names() -> list[str]:
    """The names of the folders."""
    return [one.name for one in pkgutil.iter_modules(folder.__path__)]


def first_names() -> list[str]:
    """The features that open and draw a mesh: those whose package declares `FIRST = True`.

    They are built before the others, so that the first picture need not wait for these; no feature is imported.
    """
    return [name for name in names() if getattr(import_module(f"{folder.__name__}.{name}"), "FIRST", False)]


def kind_of(name: str) -> type[Feature]:
    """Import the feature of a folder, and return its class.

    Raises
    ------
    TypeError
        If its module `feature` declares none, or several.
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


def in_order(kinds: Iterable[type[Feature]]) -> list[type[Feature]]:
    """Classes of features in the order in which they are built."""
    return sorted(kinds, key=lambda kind: (kind.order, kind.__module__))


def found() -> list[type[Feature]]:
    """The class of every feature, in the order in which they are built."""
    return in_order(map(kind_of, names()))


def name_of(kind: type[Feature]) -> str:
    """The name of a feature: its folder's."""
    return kind.__module__.split(".")[-2]


def building(host: Host, built: dict[str, Feature]) -> Generator[None, None, dict[str, Feature]]:
    """Import and build all features that are not built yet, step by step.

    Parameters
    ----------
    host : Host
    built : dict
        Features by the names of their folders.

    Returns
    -------
    dict
        All features by name, in their order; those that raise are left out and reported.
    """
    for name in names():
        kind_of(name)  # its imports take longer than building it
        yield
    kinds, all_of_them = found(), dict(built)
    for kind in kinds:
        if name_of(kind) not in all_of_them:
            try:
                all_of_them[name_of(kind)] = kind(host)
            except Exception:  # the other features are built whatever one raises
                sys.excepthook(*sys.exc_info())
            yield
    return {name_of(kind): all_of_them[name_of(kind)] for kind in kinds if name_of(kind) in all_of_them}
