"""Extension module of the native functions that only tests call.

It is built with the other kernels by make and by scripts/build-kernels, and is no part of a wheel.
"""

from types import ModuleType

import pytest


def extension() -> ModuleType:
    """Return the module; skips the tests of the calling file where it is not built."""
    return pytest.importorskip(
        "tests.hexmend_test_kernels", reason="hexmend_test_kernels is not built: run scripts/build-kernels .venv/bin"
    )
