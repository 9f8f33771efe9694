"""Benchmark of whole processes: the time that a user waits for a command."""

from __future__ import annotations

import json
import math
import os
import shlex
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path
from statistics import median
from time import perf_counter
from typing import Any

from benchmarks.section import BenchSection, mesh_files
from hexmend.gallery import make
from hexmend.io import write

#: Number of runs of each command.
_TIMES = 5

#: Variable that names another program to compare, run in turn with this one.
_OTHER = "HEXMEND_BEFORE"


def _run(program: Sequence[str], words: Sequence[str]) -> float:
    began = perf_counter()
    done = subprocess.run([*program, *words], capture_output=True, text=True, check=False)
    seconds = perf_counter() - began
    if done.returncode not in (0, 4):
        raise RuntimeError(f"{shlex.join([*program, *words])}: {done.stderr.strip()}")
    return seconds


def _smoothing(program: Sequence[str], mesh: Path, folder: Path) -> tuple[float, float]:
    """Smooth a mesh; return the seconds of the process, and of the method in it."""
    report = folder / "report.json"
    seconds = _run(program, ["smooth", str(mesh), "-o", str(folder / f"smoothed{mesh.suffix}"), "--json", str(report)])
    return seconds, json.loads(report.read_text(encoding="utf-8"))["seconds"]


def _meshes(folder: Path) -> list[Path]:
    """List readable meshes of the folder in the variable HEXMEND_MESHES, else one of the gallery."""
    if not os.environ.get("HEXMEND_MESHES"):
        write(folder / "bridge-sharp.mesh", make("bridge-sharp", size=7500))
        return [folder / "bridge-sharp.mesh"]
    here = [sys.executable, "-m", "hexmend"]
    return [path for path in mesh_files() if not subprocess.run([*here, "info", path], capture_output=True).returncode]


def _processes() -> dict[str, Any]:
    programs = {"now": [sys.executable, "-m", "hexmend"]}
    if _OTHER in os.environ:
        programs["before"] = shlex.split(os.environ[_OTHER])
    commands: dict[str, dict[str, float]] = {}
    smoothed: dict[str, dict[str, float]] = {}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        meshes = _meshes(folder)
        for command in (["--version"], ["--help"], ["info", str(meshes[-1])]):
            timings = {label: [_run(program, command) for _ in range(_TIMES)] for label, program in programs.items()}
            commands[" ".join([*command[:1], *(Path(word).name for word in command[1:])])] = {
                label: median(seconds) for label, seconds in timings.items()
            }
        for mesh in meshes:
            rows: dict[str, list[tuple[float, float]]] = {label: [] for label in programs}
            for _ in range(_TIMES):
                for label, program in programs.items():
                    rows[label].append(_smoothing(program, mesh, folder))
            smoothed[mesh.name] = {
                f"{label}{suffix}": median(row[k] for row in timings)
                for label, timings in rows.items()
                for k, suffix in enumerate(("", "_method"))
            }
    return {"commands": commands, "smooth": smoothed}


def _lines(figures: dict[str, Any]) -> list[str]:
    lines = [f"hexmend {name:<42} {_pair(row, '')}" for name, row in figures["commands"].items()]
    for name, row in figures["smooth"].items():
        lines.append(f"hexmend smooth {name:<35} {_pair(row, '')}   of it the method {_pair(row, '_method')}")
    rows = list(figures["smooth"].values())
    if rows and "before" in rows[0]:
        for suffix, title in (("", "processes"), ("_method", "methods")):
            ratios = [row[f"before{suffix}"] / row[f"now{suffix}"] for row in rows]
            mean = math.exp(sum(map(math.log, ratios)) / len(ratios))
            lines.append(f"{title}: {mean:.2f} times faster in geometric mean, {min(ratios):.2f} at least")
    return lines


def _pair(row: dict[str, float], suffix: str) -> str:
    now, before = row[f"now{suffix}"], row.get(f"before{suffix}")
    return f"{now:7.3f} s" + (f" (before {before:7.3f} s, {before / now:5.2f} x)" if before else "")


_TITLE = f"Whole processes (median of {_TIMES}; {_OTHER} names a program to compare)"
PROCESSES = BenchSection("processes", _TITLE, _processes, _lines)
