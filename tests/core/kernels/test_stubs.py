"""The stubs of the compiled kernels are those of the module that is built."""

import importlib.util
from pathlib import Path

import pytest

from hexmend import kernels

ROOT = Path(__file__).resolve().parents[3]


def test_the_stubs_say_what_the_module_has(tmp_path):
    pytest.importorskip("nanobind")
    spec = importlib.util.spec_from_file_location("kernel_stubs", ROOT / "scripts/kernel_stubs.py")
    stubs = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(stubs)
    written = stubs.write(tmp_path)
    there = Path(kernels.__file__).parent
    assert {path.name for path in written} == {path.name for path in there.glob("*.pyi")}
    for path in written:
        assert path.read_text() == (there / path.name).read_text(), f"{path.name}: run python scripts/kernel_stubs.py"
