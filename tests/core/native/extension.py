"""Extension modules of the native functions that only tests and benchmarks call.

They are built with the other kernels by make and by scripts/build-kernels, and are no part of a wheel.
"""

from types import ModuleType

import pytest


def extension() -> ModuleType:
    """Return the module; skips the tests of the calling file where it is not built."""
    return pytest.importorskip(
        "tests.hexmend_test_kernels", reason="hexmend_test_kernels is not built: run scripts/build-kernels .venv/bin"
    )


def scalar_reference() -> ModuleType:
    """Return the scalar reference of the kernels; skips the tests of the calling file where it is not built."""
    return pytest.importorskip(
        "benchmarks.kernels.scalar_reference", reason="it is not built: run scripts/build-kernels .venv/bin"
    )
