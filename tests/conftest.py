"""What all tests share."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import settings

os.environ.setdefault("QT_API", "pyside6")
os.environ.setdefault("PYQTGRAPH_QT_LIB", "PySide6")
os.environ["QT_QPA_PLATFORM"] = "xcb"  # 3D needs a screen, a virtual one at least

# Kernels compile in the first example, and machines are shared: no example has a deadline.
settings.register_profile("hexmend", deadline=None, max_examples=40, derandomize="CI" in os.environ)
settings.load_profile("hexmend")

_REAL = Path(os.environ.get("HEXMEND_MESHES", Path(__file__).resolve().parents[2] / "shared" / "meshes"))


@pytest.fixture(scope="session")
def real_mesh() -> Callable[[str], Path]:
    """The path of one of the real meshes; the test is skipped where they are absent."""

    def find(name: str) -> Path:
        if not (_REAL / name).exists():
            pytest.skip(f"the real mesh {name} is not in {_REAL}")
        return _REAL / name

    return find
