"""Classes of the app do not hide methods of their Qt base classes."""

import ast
import importlib
import inspect
import pkgutil
import textwrap
from collections.abc import Iterator

import pytest
from PySide6.QtCore import QObject, Signal

import hexmend_app

#: Modules that start the program when they are imported.
_PROGRAMS = {"hexmend_app.__main__"}


def qt_classes() -> list[type[QObject]]:
    """Return the classes of the app that derive from a Qt class."""
    classes = set()
    for module in pkgutil.walk_packages(hexmend_app.__path__, "hexmend_app."):
        if module.name not in _PROGRAMS:
            for value in vars(importlib.import_module(module.name)).values():
                if inspect.isclass(value) and issubclass(value, QObject) and value.__module__ == module.name:
                    classes.add(value)
    return sorted(classes, key=lambda kind: (kind.__module__, kind.__qualname__))


def hidden_methods(kind: type) -> set[str]:
    """Return the methods of Qt that a class hides by a property, a signal or an attribute.

    Signals are treated separately, as they are callable on the class but not on an object.
    """
    qt = next(base for base in kind.mro() if base.__module__.startswith("PySide6"))
    names = {name for name, value in vars(kind).items() if isinstance(value, Signal) or not callable(value)}
    names |= set(attributes_set(kind))
    return {name for name in names if not name.startswith("__") and callable(getattr(qt, name, None))}


def attributes_set(kind: type) -> Iterator[str]:
    """Yield the names of attributes that the methods of a class assign."""
    for node in ast.walk(ast.parse(textwrap.dedent(inspect.getsource(kind)))):
        match node:
            case ast.Attribute(value=ast.Name(id="self"), attr=name, ctx=ast.Store()):
                yield name


@pytest.mark.slow
def test_no_class_hides_a_method_of_its_qt_class(qapp):
    classes = qt_classes()
    assert len(classes) > 50
    assert {
        f"{kind.__module__}.{kind.__qualname__}": names for kind in classes if (names := hidden_methods(kind))
    } == {}
