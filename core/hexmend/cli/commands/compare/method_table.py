"""The table of `hexmend compare`: a row for each method."""

from __future__ import annotations

import argparse
import re
import sys
from pathlib import Path

from hexmend.cli.arguments import run_arguments
from hexmend.cli.output.progress import Progress
from hexmend.cli.output.text_tables import print_table
from hexmend.cli.process.interrupts import FinishWriting
from hexmend.io import Original, read, write_as_given, writer_for
from hexmend.io.format_lookup import copy_suffix
from hexmend.mesh.rules.resolution import with_rules
from hexmend.report.comparison import comparison_rows, record_table
from hexmend.report.documents import output_folder, write_documents
from hexmend.run.recipe import Recipe
from hexmend.smoothers import METHODS
from hexmend.study.compare import compare
from hexmend.study.method_spec import parse_methods, split_names


def run(args: argparse.Namespace) -> int:
    """Run the methods, write the tables, and print one.

    Returns 3 if all methods failed, 128 and the signal's number if interrupted.
    """
    names = split_names(args.methods) if args.methods else list(METHODS)
    settings = run_arguments.method_settings(args, [name for name in names if not name.endswith(".toml")])
    smoothers = parse_methods(names, settings, run_arguments.given_limits(args))
    limits = run_arguments.stopping_criteria(args)
    mesh = with_rules(read(args.mesh), rules := run_arguments.given_rules(args))
    smoothers = [one.with_more_rules(rules, args.interfaces) if isinstance(one, Recipe) else one for one in smoothers]
    run_arguments.check_element_targets(smoothers, mesh)
    run_arguments.check_memory(args, smoothers, mesh, "compare fewer methods (--methods)")
    sliding = run_arguments.with_surface(args, mesh, *smoothers)
    folder = output_folder(args.output)
    suffix, original = copy_suffix(args.mesh), Original(Path(args.mesh), mesh)
    if args.write_meshes:
        writer_for(
            folder / f"mesh{suffix}", args.mesh
        )  # raises now, and not after the runs, for a format that is only read
    with FinishWriting():
        with Progress() as progress:
            comparison = compare(sliding, smoothers, limits, watch=progress.show)
        record = comparison.record()
        table = record_table(record)
        paths = write_documents(folder, "comparison", table, comparison_rows(record), record)
        for row in comparison.rows if args.write_meshes else ():
            if row.mesh is not None:
                paths.append(folder / f"{mesh.name}-{re.sub(r'[^A-Za-z0-9]+', '-', row.method)}{suffix}")
                write_as_given(paths[-1], row.mesh, None if suffix else original)
        print_table(table)
        print(f"Written to {args.output}: {', '.join(path.name for path in paths)}.")
        if comparison.interrupted:
            print("Interrupted: the table holds the results so far.", file=sys.stderr)
    if comparison.interrupted:
        return progress.signals.status
    if all(row.mesh is None for row in comparison.rows):
        print("hexmend: every method failed: see the table for the reasons.", file=sys.stderr)
        return 3
    return 0
