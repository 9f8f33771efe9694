"""What a part of the benchmark is."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class BenchSection:
    """A part of the benchmark.

    Parameters
    ----------
    name, title : str
    measure : callable
        Returns figures that JSON can hold.
    lines : callable
        The figures as lines to read.
    """

    name: str
    title: str
    measure: Callable[[], dict[str, Any]]
    lines: Callable[[dict[str, Any]], list[str]]


#: Hexes of the meshes that a figure is measured on against size.
_SIZES = 10_000, 100_000, 1_000_000


def by_size(program: str) -> list[dict[str, Any]]:
    """What a program that is given a size prints as JSON, for each size in a process, and a memory, of its own."""
    rows = []
    for size in _SIZES:
        done = subprocess.run([sys.executable, "-c", program, str(size)], capture_output=True, text=True, check=True)
        rows.append(json.loads(done.stdout))
    return rows


def peak_mb() -> float:
    """The most memory that this process has held, MiB.

    Not the operating system's `ru_maxrss`, which a process inherits from the one that has started it.
    """
    try:
        return _status_mb("VmHWM")
    except OSError:
        import resource

        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


def resident_mb() -> float:
    """The memory that this process holds now, MiB.

    Raises
    ------
    OSError
        Where the system has no /proc.
    """
    return _status_mb("VmRSS")


def _status_mb(field: str) -> float:
    with open("/proc/self/status", encoding="ascii") as file:
        return next(int(line.split()[1]) / 1024 for line in file if line.startswith(field))
