"""Write the stubs of the compiled kernels next to them, from the built module; tests compare.

Use: python scripts/kernel_stubs.py [FOLDER]     core/hexmend/kernels where none is named; needs nanobind
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path

from hexmend import kernels

HERE = Path(__file__).resolve().parents[1] / "core/hexmend/kernels"

FACE = '''"""Compiled kernels: functions of arrays and of views of arrays. Written by scripts/kernel_stubs.py."""

{families}

BUILD: str
BUILDS: tuple[str, ...]
LANES: int

def threads() -> int: ...
def set_threads(count: int) -> None: ...
def release_free_memory() -> None: ...
def return_freed_arrays() -> None: ...
'''


def write(folder: Path) -> list[Path]:
    """Write a stub for each family, and one for the package; returns them."""
    with tempfile.TemporaryDirectory() as scratch:
        words = ["-r", "-q", "-m", f"hexmend.kernels._{kernels.BUILD}", "-O", scratch]
        subprocess.run([sys.executable, "-m", "nanobind.stubgen", *words], check=True)
        found = sorted(path for path in Path(scratch).rglob("*.pyi") if path.stem != "__init__")
        written = []
        for path in found:
            written.append(folder / path.name)
            text = path.read_text(encoding="utf-8").replace(f"hexmend.kernels._{kernels.BUILD}", "hexmend.kernels")
            written[-1].write_text(text, encoding="utf-8")
    lines = "\n".join(f"from hexmend.kernels import {path.stem} as {path.stem}" for path in found)
    written.append(folder / "__init__.pyi")
    written[-1].write_text(FACE.format(families=lines), encoding="utf-8")
    return written


if __name__ == "__main__":
    write(Path(sys.argv[1]) if len(sys.argv) > 1 else HERE)
