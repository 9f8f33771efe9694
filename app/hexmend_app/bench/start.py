"""Seconds until the window and the mesh are on the screen, measured in new processes."""

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
from hexmend_app.shell.start.display import DisplayError, check_display

_TIMES = 5
_PATIENCE = 120.0  # seconds for a start

#: Measured moments, and their descriptions.
MOMENTS = {
    "window": "the window is on the screen",
    "picture": "the demo's picture is drawn",
    "panels": "all panels are there",
}


def started(mesh: Path | None = None) -> dict[str, dict[str, Any]]:
    """Start the program, wait until it shows its mesh, and quit.

    Parameters
    ----------
    mesh : Path, optional
        The bundled demo by default.

    Returns
    -------
    dict
        For each of `MOMENTS`: `seconds` since the start of the process, and the `modules` loaded by then.
    """
    from hexmend_app.shell.start.start_report import VARIABLE  # imports Qt, which needs libraries of a display

    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder) / "report"
        report.touch()
        settings = {VARIABLE: str(report), "XDG_CONFIG_HOME": folder}  # those of a first start
        words = [sys.executable, "-m", "hexmend", "view", *([] if mesh is None else [str(mesh)])]
        began = time.monotonic()
        with subprocess.Popen(words, env=os.environ | settings, stderr=subprocess.PIPE, text=True) as process:
            try:
                reported = _read(report, process, began)
                process.send_signal(signal.SIGINT)
                sentence = process.communicate(timeout=_PATIENCE)[1]
            finally:
                process.kill()  # the program may hang
        if len(reported) < len(MOMENTS):
            raise HexmendError(f"the program ended, or hung, before its mesh was shown: {sentence.strip()}")
        if process.returncode:
            raise HexmendError(f"the program ended with {process.returncode} on closing: {sentence.strip()}")
    return {one["moment"]: {"seconds": one["at"] - began, "modules": one["modules"]} for one in reported}


def _read(report: Path, process: subprocess.Popen, began: float) -> list[dict[str, Any]]:
    """Return the lines of the report, once it is complete or the process has ended."""
    while True:
        ended = process.poll() is not None or time.monotonic() - began > _PATIENCE
        lines = report.read_text(encoding="utf-8").split("\n")[:-1]
        if ended or len(lines) == len(MOMENTS):
            return [json.loads(line) for line in lines]
        time.sleep(0.02)


def _measure() -> dict[str, Any]:
    try:
        check_display()
    except DisplayError as error:
        return {"skipped": str(error)}
    started()  # fills the cache of the file system
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
        return [f"skipped: {figures['skipped']}"]
    return [
        f"{title:<30} {figures[moment]['seconds']:6.2f} s (at best {figures[moment]['least_seconds']:.2f} s), "
        f"{figures[moment]['modules']:,} modules loaded"
        for moment, title in MOMENTS.items()
    ]


start = BenchSection("start", f"Start of the viewer, warm (median of {_TIMES})", _measure, _lines)
