"""Classes of the app do not hide methods of their Qt base classes."""

import ast
import doctest
import importlib
import inspect
import pkgutil
import textwrap
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path

import pytest
from PySide6.QtCore import QCoreApplication, QObject, QTranslator, Signal

import hexmend_app
from hexmend_app.translation import tr
from hexmend_app.widgets.wording import counted

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


# Texts of the window in another language, by Qt's translators.


GERMAN = {"Flip": "Umkehren", "{count:,} hidden": "{count:,} versteckt", "nodes": "Knoten"}


class German(QTranslator):
    """Translation as of a file of Qt Linguist, whose context of functions outside classes is empty."""

    def translate(self, context, text, comment=None, number=-1):
        return GERMAN.get(text) if context == "" else None


@pytest.fixture
def german(qapp):
    translator = German()
    QCoreApplication.installTranslator(translator)
    yield
    QCoreApplication.removeTranslator(translator)


def test_texts_are_those_of_the_translation_and_else_english(german):
    assert [tr("Flip"), tr("{count:,} hidden", count=1234), tr("Stop")] == ["Umkehren", "1,234 versteckt", "Stop"]
    assert [counted(2, "node"), counted(1, "node")] == ["2 Knoten", "1 node"]


# Examples in docstrings of the app.


APP = Path(hexmend_app.__file__).parent
MODULES = [
    ".".join(("hexmend_app", *path.relative_to(APP).with_suffix("").parts))
    for path in sorted(APP.rglob("*.py"))
    if ">>>" in path.read_text(encoding="utf-8")
]


@pytest.mark.parametrize("name", MODULES)
def test_examples_print_their_output(name):
    result = doctest.testmod(import_module(name), optionflags=doctest.IGNORE_EXCEPTION_DETAIL)
    assert result.failed == 0
