"""Sections of the benchmark."""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

#: Counts of hexes of a summary in the tables.
COUNTS = ("inverted", "invalid")


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


def smoothed(mesh: Path, *words: str) -> tuple[dict[str, Any], float]:
    """Run `hexmend smooth` on a mesh.

    Parameters
    ----------
    mesh : Path
    *words : str
        More options of the command.

    Returns
    -------
    report : dict
        What `--json` writes.
    seconds : float
        Of the whole process.

    Raises
    ------
    FileNotFoundError
        The command ended without a report.
    """
    with tempfile.TemporaryDirectory() as folder:
        output = Path(folder) / "report.json"
        command = ["smooth", str(mesh), "-o", f"{folder}/out.vtu", "--json", str(output), *words]
        begun = time.perf_counter()
        subprocess.run([sys.executable, "-m", "hexmend", *command], capture_output=True, check=False)
        seconds = time.perf_counter() - begun
        return json.loads(output.read_text("utf-8")), seconds
