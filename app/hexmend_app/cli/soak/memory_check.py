"""Implementation of `hexmend soak`."""

from __future__ import annotations

import argparse

from hexmend.cli.process.interrupts import ExitAfterIteration, FinishWriting
from hexmend.errors import HexmendError
from hexmend.report import write_json
from hexmend.run.memory import resident_mb
from hexmend_app.cli.numbers import numbers
from hexmend_app.resources import demo_mesh
from hexmend_app.shell.start.display import check_display


def run(args: argparse.Namespace) -> int:
    """Run rounds until the time is over; return 1 if the memory grows."""
    (minutes,) = numbers(args.minutes, 1, "--minutes")
    check_display()
    from hexmend_app.bench.soak import Memory, soak  # imports Qt, which needs the libraries of a display

    try:
        resident_mb()
    except OSError:
        raise HexmendError("soak needs a system with /proc, such as Linux, to measure the memory") from None
    memory = Memory()
    with FinishWriting():
        with ExitAfterIteration("round") as signals:
            for sample in soak(args.mesh or [demo_mesh()], 60 * minutes):
                memory.add(sample)
                print(sample, flush=True)
                if signals.asked:
                    break
        if args.json:
            write_json(args.json, memory.record())
        print(memory.verdict)
    if signals.asked:
        return signals.status
    return 0 if memory.level else 1
