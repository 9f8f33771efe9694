"""`hexmend compare`: several methods on one mesh, as the thesis's table."""

from __future__ import annotations

import argparse
import re
import sys
from pathlib import Path


class Compare:
    """Methods side by side."""

    name = "compare"
    help = "Run several methods on a mesh and write their figures as CSV, Markdown, LaTeX and JSON."

    def arguments(self, parser: argparse.ArgumentParser) -> None:
        from hexmend.cli.arguments.method import add_settings

        parser.add_argument("mesh", metavar="MESH", help="the mesh file")
        parser.add_argument("-o", "--output", metavar="DIR", required=True, help="folder of the tables")
        parser.add_argument(
            "--methods",
            metavar="A,B,...",
            help="see `hexmend methods` (default: all of them); a FILE.toml is a recipe",
        )
        add_settings(parser)
        parser.add_argument("--write-meshes", action="store_true", help="write each method's mesh into the folder too")

    def run(self, args: argparse.Namespace) -> int:
        from hexmend.cli.arguments.limits import given_limits, limits
        from hexmend.cli.arguments.memory_check import check_memory
        from hexmend.cli.arguments.method import with_boundary
        from hexmend.cli.output.progress import Progress
        from hexmend.cli.output.rich_tables import print_table
        from hexmend.cli.process.interrupts import FinishesWriting
        from hexmend.io import read, write, writer_for
        from hexmend.report import comparison_rows, made_folder, table_of, write_documents
        from hexmend.smoothers import METHODS
        from hexmend.study.compare import compare
        from hexmend.study.method_spec import chosen, split

        names = split(args.methods) if args.methods else list(METHODS)
        settings = with_boundary(args, [name for name in names if not name.endswith(".toml")])
        smoothers, stop = chosen(names, settings, given_limits(args)), limits(args)
        mesh = read(args.mesh)
        check_memory(args, smoothers, mesh, "compare fewer methods (--methods)")
        folder = made_folder(args.output)
        suffix = Path(args.mesh).suffix
        if args.write_meshes:
            writer_for(folder / f"mesh{suffix}")
        with FinishesWriting():
            with Progress() as progress:
                comparison = compare(mesh, smoothers, stop, watch=progress.show)
            record = comparison.record()
            table = table_of(record)
            paths = write_documents(folder, "comparison", table, comparison_rows(record), record)
            for row in comparison.rows if args.write_meshes else ():
                if row.mesh is not None:
                    paths.append(folder / f"{mesh.name}-{re.sub(r'[^A-Za-z0-9]+', '-', row.method)}{suffix}")
                    write(paths[-1], row.mesh)
            print_table(table)
            print(f"Written to {args.output}: {', '.join(path.name for path in paths)}.")
            if comparison.interrupted:
                print("Interrupted: the table holds what was done so far.", file=sys.stderr)
        return progress.signals.status if comparison.interrupted else 0


command = Compare()
