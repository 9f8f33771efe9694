"""The run of `hexmend smooth`, from file to file."""

from __future__ import annotations

import argparse
import os
import sys
from dataclasses import replace
from importlib import import_module

import numpy as np

from hexmend.advice import advise
from hexmend.cli.arguments import run_arguments
from hexmend.cli.arguments.options import DEFAULT_RINGS
from hexmend.cli.commands.smooth.checkpoint import Checkpoints
from hexmend.cli.commands.smooth.suggested_command import RunOptions, suggested_command
from hexmend.cli.output.mesh_output import MeshOutput, mid_node_advice, print_notes, print_problems
from hexmend.cli.output.progress import follow
from hexmend.cli.output.text_tables import print_summaries
from hexmend.cli.process.interrupts import FinishWriting
from hexmend.errors import ParameterError
from hexmend.io import read, writer_for
from hexmend.io.surfaces.read import with_curves_of_file
from hexmend.iteration import Iteration, Result
from hexmend.mesh.fixing import fix_outside
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.rules import MotionRules
from hexmend.mesh.rules.resolution import with_rules
from hexmend.quality.selection import hexes_in_set
from hexmend.report.records import record, write_history, write_json
from hexmend.run import iterate
from hexmend.run.interface_messages import describe_embedded
from hexmend.run.recipe import Recipe
from hexmend.run.recipe_files import write_recipe
from hexmend.terminal_text import install_hint


def run(args: argparse.Namespace) -> int:
    """Read the mesh, smooth it, write it and the reports; return 4 if hexes are still invalid."""
    if _is_one_of_several_ranks():
        return _run_on_ranks(args)
    method, limits = run_arguments.method_and_limits(args)
    writer_for(args.output, None if args.rewrite else args.mesh)  # raises before the run, and not after it
    checkpoints = Checkpoints(args.output, args.checkpoint)
    run_arguments.check_targets(args.mesh, args.output, args.json, args.history, args.save_recipe)
    rings = _rings(args)
    mesh = read(args.mesh, as_is=args.as_is)
    output = MeshOutput(args.output, args.mesh, mesh, args.rewrite)
    print_notes(mesh, output.replaces_coordinates)
    print_problems(args.mesh, mesh)
    output.warn_of_losses(mesh)
    pinned = mesh.pinned  # as in the file, for the output: --only holds for this run alone
    mesh = with_rules(mesh, run_arguments.motion_rules(args))
    if args.ridges:
        mesh = with_curves_of_file(mesh, args.ridges)
    if isinstance(method, Recipe):  # the mesh has the recipe's rules now, changed by the options
        method = replace(method, rules=MotionRules())
    if args.only:
        mesh = fix_outside(mesh, hexes_in_set(mesh, args.only), rings)
    run_arguments.check_memory(args, [method], mesh, *([] if args.only else ["smooth a part of it (--only)"]))
    smoothing = iterate(run_arguments.with_surface(args, mesh, method), method, limits)
    if smoothing.layers:
        print(f"hexmend: {smoothing.layers_message}", file=sys.stderr)
    elif args.layers == "keep":
        print("hexmend: --layers keep has no effect: no boundary layers were found.", file=sys.stderr)
    if embedded := describe_embedded(mesh):
        print(f"hexmend: {embedded}", file=sys.stderr)
    if args.interfaces and mesh.materials is None and not mesh.embedded.any():
        print(f"hexmend: --interfaces {args.interfaces} has no effect: the mesh has one material.", file=sys.stderr)
    if args.save_recipe:
        write_recipe(args.save_recipe, smoothing.recipe)
    mesh.topology.release_faces()  # few methods need them
    with FinishWriting():
        follow(smoothing, lambda iteration: _keep(checkpoints, mesh.replace(pinned=pinned), iteration))
        smoothing.move_mid_nodes()
        result = smoothing.result()
        written = output.write(result.mesh.replace(pinned=pinned))
        checkpoints.remove()
        _report(args, method.title, result, written)
        if not result.after.inverted and (advice := mid_node_advice(args.output, result.mesh)):
            print(advice)
        elif result.after.invalid:
            kept = RunOptions(mesh.node_rules.rules, args.as_is, args.surface, args.only, rings)
            _print_advice(args, result, _outside(mesh, pinned), kept)
    return 4 if result.after.invalid else 0


def _is_one_of_several_ranks() -> bool:
    """Return True if an MPI launcher has started this process together with others."""
    sizes = ["OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "MV2_COMM_WORLD_SIZE"]
    sizes += ["SLURM_NTASKS"] if "PMIX_RANK" in os.environ else []  # of srun, whose batch jobs have it too
    return any(os.environ.get(name, "1") not in ("", "0", "1") for name in sizes)


def _run_on_ranks(args: argparse.Namespace) -> int:
    try:
        return import_module("hexmend.cli.commands.smooth.on_ranks").run(args)
    except ModuleNotFoundError as error:
        if (error.name or "").partition(".")[0] not in ("mpi4py", "pymetis"):
            raise
        raise ParameterError(f"several processes need mpi4py and pymetis: {install_hint('mpi')}") from None


def _keep(checkpoints: Checkpoints, mesh: Mesh, iteration: Iteration) -> None:
    """Write a checkpoint with the points of an iteration if it is due."""
    if checkpoints.due:
        checkpoints.write(lambda: mesh.with_points(iteration.points))


def _report(args: argparse.Namespace, title: str, result: Result, written: str) -> None:
    """Write the files of --json and --history, and print the change of the mesh."""
    if args.json:
        write_json(args.json, record(result))
    if args.history:
        write_history(args.history, result)
    print_summaries(f"{args.mesh}: {title}", ["before", "after"], [result.before, result.after], result.target_q)
    print(result.message)
    for wall in result.layers:
        print(wall.sentence)
    if result.surface is not None:
        print(result.surface_sentence)
    print(written)


def _print_advice(args: argparse.Namespace, result: Result, outside: np.ndarray | None, options: RunOptions) -> None:
    """Print the state of a mesh with invalid hexes and what to try next, with the commands."""
    advice = advise(result, outside)
    print(advice.state)
    for suggestion in advice.suggestions:
        print(f"Try next: {suggestion.text}")
        if line := suggested_command(suggestion, args.mesh, args.output, options):
            print(f"      {line}")


def _rings(args: argparse.Namespace) -> int:
    """Return the number of rings around the hexes of --only; raises `ParameterError` without that option."""
    if args.rings is None:
        return DEFAULT_RINGS
    if not args.only:
        raise ParameterError(f"--rings {args.rings} is for a part of the mesh: name it with --only, or leave it out")
    if args.rings < 0:
        raise ParameterError(f"--rings {args.rings} is out of bounds: expected a number of at least 0")
    return args.rings


def _outside(mesh: Mesh, pinned: np.ndarray | None) -> np.ndarray | None:
    """Mark the nodes of a mesh (n,) bool that are pinned for the run, and not by the file; None if there are none."""
    if mesh.pinned is None or mesh.pinned is pinned:
        return None
    return mesh.pinned if pinned is None else mesh.pinned & ~pinned
