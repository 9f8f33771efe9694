"""Measuring whole processes: what somebody who types a command waits for."""

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

from hexmend.gallery import make
from hexmend.io import readable_suffixes, write
from hexmend.study.bench.section import BenchSection

#: How often each command is run.
_TIMES = 5

#: Names another program to be timed beside this one, run by run in turn.
_OTHER = "HEXMEND_BEFORE"


def _run(program: Sequence[str], words: Sequence[str]) -> float:
    began = perf_counter()
    done = subprocess.run([*program, *words], capture_output=True, text=True, check=False)
    seconds = perf_counter() - began
    if done.returncode not in (0, 4):
        raise RuntimeError(f"{shlex.join([*program, *words])}: {done.stderr.strip()}")
    return seconds


def _smoothing(program: Sequence[str], mesh: Path, folder: Path) -> tuple[float, float]:
    """Seconds of the process, and those of the method in it."""
    report = folder / "report.json"
    seconds = _run(program, ["smooth", str(mesh), "-o", str(folder / f"smoothed{mesh.suffix}"), "--json", str(report)])
    return seconds, json.loads(report.read_text(encoding="utf-8"))["seconds"]


def _meshes(folder: Path) -> list[Path]:
    """Those of the folder that the variable HEXMEND_MESHES names and that can be read, else one of the gallery."""
    named = os.environ.get("HEXMEND_MESHES")
    if not named:
        write(folder / "bridge-sharp.mesh", make("bridge-sharp", size=7500))
        return [folder / "bridge-sharp.mesh"]
    here = [sys.executable, "-m", "hexmend"]
    found = [path for path in sorted(Path(named).iterdir()) if path.suffix in readable_suffixes()]
    return [path for path in found if not subprocess.run([*here, "info", path], capture_output=True).returncode]


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
            taken = {which: [_run(program, command) for _ in range(_TIMES)] for which, program in programs.items()}
            commands[" ".join([*command[:1], *(Path(word).name for word in command[1:])])] = {
                which: median(seconds) for which, seconds in taken.items()
            }
        for mesh in meshes:
            rows: dict[str, list[tuple[float, float]]] = {which: [] for which in programs}
            for _ in range(_TIMES):
                for which, program in programs.items():
                    rows[which].append(_smoothing(program, mesh, folder))
            smoothed[mesh.name] = {
                f"{which}{what}": median(row[k] for row in taken)
                for which, taken in rows.items()
                for k, what in enumerate(("", "_method"))
            }
    return {"commands": commands, "smooth": smoothed}


def _lines(figures: dict[str, Any]) -> list[str]:
    lines = []
    for name, row in figures["commands"].items():
        lines.append(f"hexmend {name:<42} {_pair(row, '')}")
    for name, row in figures["smooth"].items():
        lines.append(f"hexmend smooth {name:<35} {_pair(row, '')}   of it the method {_pair(row, '_method')}")
    rows = list(figures["smooth"].values())
    if rows and "before" in rows[0]:
        for what, title in (("", "processes"), ("_method", "methods")):
            ratios = [row[f"before{what}"] / row[f"now{what}"] for row in rows]
            mean = math.exp(sum(map(math.log, ratios)) / len(ratios))
            lines.append(f"{title}: {mean:.2f} times faster in geometric mean, {min(ratios):.2f} at least")
    return lines


def _pair(row: dict[str, float], what: str) -> str:
    now, before = row[f"now{what}"], row.get(f"before{what}")
    return f"{now:7.3f} s" + (f" (before {before:7.3f} s, {before / now:5.2f} x)" if before else "")


PROCESSES = BenchSection(
    "processes", f"Whole processes (median of {_TIMES}; {_OTHER} names a program to compare)", _processes, _lines
)
