"""The work of `hexmend repair`."""

from __future__ import annotations

import argparse

from hexmend.cli.output.mesh_output import MeshOutput, print_notes
from hexmend.doctor import PROBLEMS, examine, repair
from hexmend.io import read, writer_for


def run(args: argparse.Namespace) -> int:
    """Repair the mesh, write it, and print what was repaired and what remains."""
    for name in args.only:
        PROBLEMS[name]  # raises for an unknown name before the mesh is read
    writer_for(args.output, None if args.rewrite else args.mesh)
    mesh = read(args.mesh, as_is=True, interpolate_missing=True)
    print_notes(mesh)
    given = mesh
    mesh, repaired = repair(given, args.only)
    output = MeshOutput(args.output, args.mesh, given, args.rewrite, spare=False)
    output.warn_of_losses(mesh)
    written = output.write(mesh)
    for finding in repaired:
        print(f"Repaired: {finding.message} Done: {PROBLEMS[finding.kind].action}.")
    remaining = examine(mesh)
    for finding in remaining:
        print(f"Remaining: {finding.message} {finding.remedy}".rstrip())
    if not repaired and not remaining and not mesh.notes:
        print("No problems were found.")
    print(written)
    return 0
