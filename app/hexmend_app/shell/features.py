"""Find, import and build the features: each folder below `hexmend_app.features`, and those of other packages."""

from __future__ import annotations

import inspect
import pkgutil
import sys
from collections.abc import Callable, Generator, Iterable
from importlib import import_module
from importlib.metadata import entry_points
from typing import TypeVar

import hexmend_app.features as folder
from hexmend_app.feature import Feature, Host

Declaration = TypeVar("Declaration")

#: Features in the order in which they are built and refreshed, and in which their actions are in menus. Others follow,
#: sorted by name: the appearance draws the mesh before they use what the view has drawn.
ORDER = (
    "open", "save", "export", "session", "edit", "smooth", "timeline", "recipe", "target_surface", "appearance",
    "histogram", "quality", "hex_inspector", "node_step", "camera", "cut", "measure", "structure", "curves", "doctor",
    "pad", "pyvista_window", "tags", "outcome", "convergence", "side_views", "movement", "compare", "reproduce",
    "preferences", "help",
)  # fmt: skip

#: Features that open and draw a mesh; they are built first, so that the first picture does not wait for the others.
FIRST = ("open", "appearance", "camera")

#: Entry points of features in other packages: each names a class that derives from `Feature`.
GROUP = "hexmend.features"


def feature_names() -> list[str]:
    """Return the names of the features below `hexmend_app.features`, which are those of their folders, in order."""
    names = [module.name for module in pkgutil.iter_modules(folder.__path__)]
    return sorted(names, key=lambda name: (ORDER.index(name) if name in ORDER else len(ORDER), name))


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
    sources: dict[str, Callable[[], type[Feature]]] = {}
    for name in feature_names():
        sources[name] = lambda name=name: feature_class(name)  # type: ignore[misc]
    for entry in sorted(entry_points(group=GROUP), key=lambda entry: entry.name):
        sources.setdefault(entry.name, entry.load)
    features = {}
    for name, load in sources.items():
        try:
            features[name] = built[name] if name in built else load()(host)
        except Exception:  # build the other features nevertheless
            sys.excepthook(*sys.exc_info())
        yield
    return features


def declared(
    features: Iterable[Feature], declarations: Callable[[Feature], Iterable[Declaration]]
) -> list[Declaration]:
    """List what features declare, such as their actions; a feature that raises is reported and declares nothing."""
    listed: list[Declaration] = []
    for feature in features:
        try:
            listed += list(declarations(feature))
        except Exception:  # the others are shown nevertheless
            sys.excepthook(*sys.exc_info())
    return listed


def call_each(features: Iterable[Feature], call: Callable[[Feature], object]) -> None:
    """Call each feature; those that raise are reported."""
    for feature in features:
        try:
            call(feature)
        except Exception:  # call the other features nevertheless
            sys.excepthook(*sys.exc_info())
