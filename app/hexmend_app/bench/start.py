"""Seconds until the window is on the screen, and until the mesh is: whole processes, each started anew."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from statistics import median
from typing import Any

from hexmend.errors import HexmendError
from hexmend.study.bench.section import BenchSection

_TIMES = 5
_PATIENCE = 120.0  # seconds for a start

#: What is measured, and how it is called where it is printed.
MOMENTS = {
    "window": "the window is on the screen",
    "picture": "the demo's picture is drawn",
    "panels": "all panels are there",
}


def started(mesh: Path | None = None) -> dict[str, dict[str, Any]]:
    """Start the program, wait until it shows its mesh, and end it.

    Parameters
    ----------
    mesh : Path, optional
        The bundled demo where it is None.

    Returns
    -------
    dict
        For each of `MOMENTS` its `seconds` since the process was started, and the `modules` that were loaded by then.
    """
    from hexmend_app.shell.start_report import VARIABLE

    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder) / "report"
        report.touch()
        settings = {VARIABLE: str(report), "XDG_CONFIG_HOME": folder}  # of a first start, whatever this user's are
        words = [sys.executable, "-m", "hexmend", "view", *([] if mesh is None else [str(mesh)])]
        began = time.monotonic()
        with subprocess.Popen(words, env=os.environ | settings, stderr=subprocess.PIPE, text=True) as process:
            try:
                told = _read(report, process, began)
                process.send_signal(signal.SIGINT)
                said = process.communicate(timeout=_PATIENCE)[1]
            finally:
                process.kill()  # or one that hangs would be waited for
        if len(told) < len(MOMENTS):
            raise HexmendError(f"the program ended, or hung, before its mesh was seen: {said.strip()}")
        if process.returncode:
            raise HexmendError(f"the program ended with {process.returncode} as it was to close: {said.strip()}")
    return {one["moment"]: {"seconds": one["at"] - began, "modules": one["modules"]} for one in told}


def _read(report: Path, process: subprocess.Popen, began: float) -> list[dict[str, Any]]:
    """The lines of the report, once all are there or none is to come."""
    while True:
        ended = process.poll() is not None or time.monotonic() - began > _PATIENCE
        lines = report.read_text(encoding="utf-8").split("\n")[:-1]
        if ended or len(lines) == len(MOMENTS):
            return [json.loads(line) for line in lines]
        time.sleep(0.02)


def _measure() -> dict[str, Any]:
    from hexmend_app.shell.display import DisplayError, check_display

    try:
        check_display()
    except DisplayError as error:
        return {"skipped": str(error)}
    started()  # warm: the files that are read are in memory
    rows = [started() for _ in range(_TIMES)]
    return {
        moment: {
            "seconds": median(row[moment]["seconds"] for row in rows),
            "least_seconds": min(row[moment]["seconds"] for row in rows),
            "modules": len(rows[-1][moment]["modules"]),
        }
        for moment in MOMENTS
    }


def _lines(figures: dict[str, Any]) -> list[str]:
    if "skipped" in figures:
        return [f"left out: {figures['skipped']}"]
    return [
        f"{title:<30} {figures[moment]['seconds']:6.2f} s (at best {figures[moment]['least_seconds']:.2f} s), "
        f"{figures[moment]['modules']:,} modules loaded"
        for moment, title in MOMENTS.items()
    ]


start = BenchSection("start", f"Start of the viewer, warm (median of {_TIMES})", _measure, _lines)
