"""Examples in docstrings of the app."""

import doctest
from importlib import import_module
from pathlib import Path

import pytest

import hexmend_app

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
