"""The work of `hexmend pad`, from file to file."""

from __future__ import annotations

import argparse
from typing import Any

from hexmend.cli.arguments.run_arguments import check_targets
from hexmend.cli.output.mesh_output import MeshOutput, print_notes
from hexmend.cli.output.progress import follow
from hexmend.cli.output.text_tables import print_summaries
from hexmend.cli.process.interrupts import FinishWriting
from hexmend.io import read, writer_for
from hexmend.padding import Padding, pad
from hexmend.report.records import record, write_json
from hexmend.run import iterate


def run(args: argparse.Namespace) -> int:
    """Pad the mesh, mend it, write it and the report; return 4 if hexes are invalid."""
    writer_for(args.output, args.mesh)  # raises before the run, and not after it
    check_targets(args.mesh, args.output, args.json)
    mesh = read(args.mesh, as_is=args.as_is)
    print_notes(mesh)
    choices = {"around": args.around, "rings": args.rings, "thickness": args.thickness}
    padding = pad(mesh, args.set_name, **choices, mend=False)
    output = MeshOutput(args.output, args.mesh, mesh, rewrite=False)
    output.warn_of_losses(padding.mesh)
    smoothing = None if args.no_mend else iterate(padding.mesh, **padding.settings)
    with FinishWriting():
        if smoothing is not None:
            follow(smoothing)
            padding = padding.mended(smoothing.result())
        written = output.write(padding.mesh)
        if args.json:
            write_json(args.json, _record(padding))
        print_summaries(f"{args.mesh}: padding", ["before", "after"], [padding.before, padding.after])
        print(padding.message)
        print(written)
    return 4 if padding.after.invalid else 0


def _record(padding: Padding) -> dict[str, Any]:
    """Return the report for JSON."""
    return {
        "layer": {
            "hexes": len(padding.layer),
            "first_hex": int(padding.layer[0]),
            "thickness_min": float(padding.thickness.min()),
            "thickness_mean": float(padding.thickness.mean()),
        },
        "before": padding.before.to_dict(),
        "after": padding.after.to_dict(),
        "nodes_without_space": padding.nodes_without_space.tolist(),
        "run": None if padding.run is None else record(padding.run),
    }
