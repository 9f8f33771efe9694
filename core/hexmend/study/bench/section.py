"""Sections of the benchmark."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class BenchSection:
    """Section of the benchmark.

    Parameters
    ----------
    name, title : str
        Name on the command line, heading of the output.
    measure : callable
        Returns figures for JSON.
    lines : callable
        Formats the figures as lines of text.
    """

    name: str
    title: str
    measure: Callable[[], dict[str, Any]]
    lines: Callable[[dict[str, Any]], list[str]]


#: Numbers of hexes for figures against size.
_SIZES = 10_000, 100_000, 1_000_000


def by_size(program: str) -> dict[str, Any]:
    """Run a program with each size as argument, in a new process, and return the JSON that it prints.

    Parameters
    ----------
    program : str
        Python source; the number of hexes is its argument.

    Returns
    -------
    dict
        `sizes`: one of them for each size.
    """
    rows = []
    for size in _SIZES:
        done = subprocess.run([sys.executable, "-c", program, str(size)], capture_output=True, text=True, check=True)
        rows.append(json.loads(done.stdout))
    return {"sizes": rows}
