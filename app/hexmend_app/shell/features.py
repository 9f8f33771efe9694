"""Find, import and build the features: each folder below `hexmend_app.features` contains one."""

from __future__ import annotations

import inspect
import pkgutil
import sys
from collections.abc import Callable, Generator, Iterable, Sequence
from importlib import import_module
from typing import TypeVar

import hexmend_app.features as folder
from hexmend_app.feature import Feature, Host

Declaration = TypeVar("Declaration")


def feature_names() -> list[str]:
    """Return the names of all features, which are those of their folders."""
    return [module.name for module in pkgutil.iter_modules(folder.__path__)]


def first_names() -> list[str]:
    """Return the names of the features that open and draw a mesh: their packages declare `FIRST = True`.

    They are built first, so that the first picture does not wait for the others. No module `feature` is imported.
    """
    first = []
    for name in feature_names():
        try:
            package = import_module(f"{folder.__name__}.{name}")
        except Exception:  # reported and omitted when all features are built
            continue
        if getattr(package, "FIRST", False):
            first.append(name)
    return first


def feature_class(name: str) -> type[Feature]:
    """Import the feature of a folder and return its class.

    Raises
    ------
    TypeError
        If its module `feature` does not declare exactly one feature.
    """
    module = import_module(f"{folder.__name__}.{name}.feature")
    classes = [
        kind
        for _, kind in inspect.getmembers(module, inspect.isclass)
        if issubclass(kind, Feature) and kind.__module__ == module.__name__
    ]
    if len(classes) != 1:
        raise TypeError(f"{module.__name__} declares {len(classes)} features: expected one")
    return classes[0]


def in_order(kinds: Iterable[type[Feature]]) -> list[type[Feature]]:
    """Sort classes of features into the order in which they are built."""
    return sorted(kinds, key=lambda kind: (kind.order, kind.__module__))


def feature_name(kind: type[Feature]) -> str:
    """Return the name of a feature, which is that of its folder."""
    return kind.__module__.split(".")[-2]


def build_remaining(host: Host, built: dict[str, Feature]) -> Generator[None, None, dict[str, Feature]]:
    """Import and build all features that are not built yet, step by step.

    Parameters
    ----------
    host : Host
    built : dict
        Features by name.

    Returns
    -------
    dict
        All features by name, in building order; a feature that raises is reported and omitted.
    """
    kinds, features = [], dict(built)
    for name in feature_names():
        try:
            kinds.append(feature_class(name))  # importing takes longer than building
        except Exception:  # build the other features nevertheless
            sys.excepthook(*sys.exc_info())
        yield
    kinds = in_order(kinds)
    for kind in kinds:
        if feature_name(kind) not in features:
            try:
                features[feature_name(kind)] = kind(host)
            except Exception:
                sys.excepthook(*sys.exc_info())
            yield
    return {feature_name(kind): features[feature_name(kind)] for kind in kinds if feature_name(kind) in features}


def declared(
    features: Iterable[Feature], declarations: Callable[[Feature], Sequence[Declaration]]
) -> list[Declaration]:
    """List what features declare, such as their actions; a feature that raises is reported and declares nothing."""
    listed: list[Declaration] = []
    for feature in features:
        try:
            listed += declarations(feature)
        except Exception:  # the others are shown nevertheless
            sys.excepthook(*sys.exc_info())
    return listed


def call_each(features: Iterable[Feature], call: Callable[[Feature], object]) -> None:
    """Call each feature, in the order in which they are refreshed; those that raise are reported."""
    for feature in sorted(features, key=lambda feature: feature.refresh_order):
        try:
            call(feature)
        except Exception:  # call the other features nevertheless
            sys.excepthook(*sys.exc_info())
