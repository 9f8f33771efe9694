"""Measurements of `hexmend bench`."""

from __future__ import annotations

import argparse

from hexmend.errors import ParameterError
from hexmend.report import write_json
from hexmend.study.bench.sections import machine, sections


def run(args: argparse.Namespace) -> int:
    """Measure the sections that --only names, or all of them, and print each when it is done."""
    known = sections()
    for name in args.only:
        if name not in known:
            raise ParameterError(f"--only {name!r} is unknown: expected one of {', '.join(known)}")
    report = {"machine": machine()}
    print(", ".join(f"{key} {value}" for key, value in report["machine"].items()))
    for name in args.only or known:
        section = known[name]
        print(f"\n{section.title}", flush=True)
        report[name] = section.measure()
        for line in section.lines(report[name]):
            print(f"  {line}", flush=True)
    if args.json:
        write_json(args.json, report)
    return 0
