"""No class of the app hides a method of the Qt class that it derives from."""

from __future__ import annotations

import ast
import importlib
import inspect
import pkgutil
import textwrap
from collections.abc import Iterator

import pytest
from PySide6.QtCore import QObject, Signal

import hexmend_app
from hexmend_app.shell.palette.type_to_find import TypeToFind

#: Modules that start the program when they are imported.
_PROGRAMS = {"hexmend_app.__main__"}


def qt_classes() -> list[type[QObject]]:
    """The classes of the app that derive from a Qt class."""
    found = set()
    for module in pkgutil.walk_packages(hexmend_app.__path__, "hexmend_app."):
        if module.name not in _PROGRAMS:
            for one in vars(importlib.import_module(module.name)).values():
                if inspect.isclass(one) and issubclass(one, QObject) and one.__module__ == module.name:
                    found.add(one)
    return sorted(found, key=lambda one: (one.__module__, one.__qualname__))


def hidden_methods(kind: type) -> set[str]:
    """The methods of Qt that a class hides by something that is no method: a property, a signal, an attribute.

    A signal of a class seems to be callable; that of an object is not.
    """
    qt = next(base for base in kind.mro() if base.__module__.startswith("PySide6"))
    own = {name for name, value in vars(kind).items() if isinstance(value, Signal) or not callable(value)}
    own |= set(attributes_set(kind))
    return {name for name in own if not name.startswith("__") and callable(getattr(qt, name, None))}


def attributes_set(kind: type) -> Iterator[str]:
    """Names that the methods of a class assign to `self`."""
    for node in ast.walk(ast.parse(textwrap.dedent(inspect.getsource(kind)))):
        match node:
            case ast.Attribute(value=ast.Name(id="self"), attr=name, ctx=ast.Store()):
                yield name


def test_no_class_hides_a_method_of_its_qt_class(qapp):
    kinds = qt_classes()
    assert len(kinds) > 50
    assert {f"{one.__module__}.{one.__qualname__}": names for one in kinds if (names := hidden_methods(one))} == {}


def test_a_class_that_hides_a_method_of_qt_is_found():
    class Hiding(QObject):
        event = Signal()

        def __init__(self):
            super().__init__()
            self.children = []

        @property
        def parent(self):
            return None

    assert hidden_methods(Hiding) == {"children", "event", "parent"}


@pytest.mark.slow
@pytest.mark.parametrize("name", ["window", "actions"])
def test_qt_can_ask_the_window_for_itself_and_for_its_actions(window, name):
    assert callable(getattr(window, name))
    assert window.window() is window
    assert window.findChild(TypeToFind) is not None
