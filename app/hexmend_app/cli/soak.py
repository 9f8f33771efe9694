"""`hexmend soak`: work for long in one window, and tell whether its memory stays level."""

from __future__ import annotations

import argparse


class Soak:
    """Repeats what a user does in a window and watches its memory."""

    name = "soak"
    help = "Open, smooth, look back, save and open again for long in one window; tell whether its memory stays level."

    def arguments(self, parser: argparse.ArgumentParser) -> None:
        parser.add_argument(
            "mesh",
            metavar="MESH",
            nargs="*",
            help="mesh files, taken in turn; the bundled demo mesh where none is named",
        )
        parser.add_argument(
            "--minutes", metavar="N", default="60", help="how long, at least four rounds (default %(default)s)"
        )
        parser.add_argument("--json", metavar="FILE", help="write the figures of every round")

    def run(self, args: argparse.Namespace) -> int:
        from hexmend.cli.process.interrupts import ExitAfterIteration, FinishWriting
        from hexmend.errors import HexmendError
        from hexmend.report import write_json
        from hexmend.study.bench.section import resident_mb
        from hexmend_app.cli.numbers import numbers
        from hexmend_app.resources import demo_mesh
        from hexmend_app.shell.display import check_display

        (minutes,) = numbers(args.minutes, 1, "--minutes")
        check_display()
        from hexmend_app.bench.soak import Memory, soak

        try:
            resident_mb()
        except OSError:
            raise HexmendError("soak needs a system that tells what a process holds in /proc, as Linux does") from None
        memory = Memory()
        with FinishWriting():
            with ExitAfterIteration("round") as signals:
                for sample in soak(args.mesh or [demo_mesh()], 60 * minutes):
                    memory.add(sample)
                    print(sample, flush=True)
                    if signals.asked:
                        break
            if args.json:
                write_json(args.json, memory.given())
            print(memory.verdict)
        if signals.asked:
            return signals.status
        return 0 if memory.level else 1


command = Soak()
