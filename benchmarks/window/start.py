"""Benchmark of the start: seconds until window and mesh are on the screen, in new processes."""

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

from benchmarks.section import BenchSection
from hexmend.errors import HexmendError

_TIMES = 5
_TIMEOUT = 120.0  # seconds for a start

#: Measured moments and their descriptions.
MOMENTS = {
    "window": "the window is on the screen",
    "picture": "the demo's picture is drawn",
    "panels": "all panels are built",
}


def measure_start(mesh: Path | None = None) -> dict[str, dict[str, Any]]:
    """Start the program, wait until it shows its mesh, and quit.

    Parameters
    ----------
    mesh : Path, optional
        By default the bundled demo mesh.

    Returns
    -------
    dict
        For each of `MOMENTS`: `seconds` since the start of the process, and the `modules` loaded by then.
    """
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder) / "report"
        report.touch()
        # Empty settings, as at the first start.
        settings = {"PYTHONPATH": os.pathsep.join(filter(None, sys.path)), "XDG_CONFIG_HOME": folder}
        command = [sys.executable, "-m", "benchmarks.window.start_report", str(report)]
        command += [] if mesh is None else [str(mesh)]
        start_time = time.monotonic()
        with subprocess.Popen(command, env=os.environ | settings, stderr=subprocess.PIPE, text=True) as process:
            try:
                moments = _read(report, process, start_time)
                process.send_signal(signal.SIGINT)
                output = process.communicate(timeout=_TIMEOUT)[1]
            finally:
                process.kill()  # the program may hang
        if len(moments) < len(MOMENTS):
            raise HexmendError(f"the program ended or hung before it showed its mesh: {output.strip()}")
        if process.returncode:
            raise HexmendError(f"the program ended with status {process.returncode}: {output.strip()}")
    return {one["moment"]: {"seconds": one["at"] - start_time, "modules": one["modules"]} for one in moments}


def _read(report: Path, process: subprocess.Popen, start_time: float) -> list[dict[str, Any]]:
    """Return the entries of the report when it is complete or the process has ended."""
    while True:
        ended = process.poll() is not None or time.monotonic() - start_time > _TIMEOUT
        lines = report.read_text(encoding="utf-8").split("\n")[:-1]
        if ended or len(lines) == len(MOMENTS):
            return [json.loads(line) for line in lines]
        time.sleep(0.02)


def _measure() -> dict[str, Any]:
    measure_start()  # fills the cache of the file system
    rows = [measure_start() for _ in range(_TIMES)]
    return {
        moment: {
            "seconds": median(row[moment]["seconds"] for row in rows),
            "least_seconds": min(row[moment]["seconds"] for row in rows),
            "modules": len(rows[-1][moment]["modules"]),
        }
        for moment in MOMENTS
    }


def _lines(figures: dict[str, Any]) -> list[str]:
    return [
        f"{title:<30} {figures[moment]['seconds']:6.2f} s (at best {figures[moment]['least_seconds']:.2f} s), "
        f"{figures[moment]['modules']:,} modules loaded"
        for moment, title in MOMENTS.items()
    ]


START = BenchSection("start", f"Start of the viewer, warm (median of {_TIMES})", _measure, _lines)
