"""`mpiexec -n P hexmend smooth`: a mesh that is divided among P processes."""

from __future__ import annotations

import argparse
import os
import sys
import traceback
from collections.abc import Sequence
from importlib import import_module
from time import monotonic

from hexmend.cli.arguments.checks import check_memory, check_targets
from hexmend.cli.arguments.run_arguments import method_and_limits, motion_rules
from hexmend.cli.commands.smooth.checkpoint import Checkpoints
from hexmend.cli.output.mesh_messages import print_notes, print_problems
from hexmend.cli.output.mesh_output import MeshOutput
from hexmend.cli.output.progress import LINE_INTERVAL
from hexmend.cli.output.text_tables import print_summaries
from hexmend.errors import HexmendError, ParameterError
from hexmend.io import read, writer_for
from hexmend.kernels import cores, set_threads, threads
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.rules.resolution import with_rules
from hexmend.quality import Summary, describe_regressions, measure, summarise
from hexmend.ranks.rank_part import distribute
from hexmend.ranks.rank_run import RankRun, check_distributed, gather_points
from hexmend.report import write_json
from hexmend.run.memory import format_bytes
from hexmend.run.shape_watch import ShapeWatch
from hexmend.study.bench.section import peak_mb
from hexmend.terminal_text import count_phrase

#: Variables in which launchers tell each process the number of processes on its machine.
_LOCAL_SIZES = "OMPI_COMM_WORLD_LOCAL_SIZE", "MPI_LOCALNRANKS"
#: Options that need the whole run in one process.
_SINGLE = "recipe", "surface", "ridges", "only", "save_recipe", "history"


def run(args: argparse.Namespace) -> int:
    """Smooth a mesh on all ranks of the program; rank 0 reads and writes. Returns 4 if hexes are still inverted."""
    comm = import_module("mpi4py.MPI").COMM_WORLD  # which begins MPI
    _share_processors()
    mesh, problem = None, None
    try:
        method, limits = method_and_limits(args)
        checkpoints = Checkpoints(args.output, args.checkpoint)
        if comm.rank == 0:
            mesh = _prepare(args, method)
            check_memory(args, [method], mesh.n_hexes * _local_ranks() // comm.size, "use more machines")
    except HexmendError as error:
        problem = error
    if comm.allreduce(problem is not None):
        if problem is not None and comm.rank == 0:
            raise problem
        return 3
    try:
        part, mesh = distribute(comm, mesh), None  # rank 0 does not keep the whole mesh
        run = RankRun(part, method, limits)
        _iterate(args, run, checkpoints)
        return _finish(args, run, checkpoints, method.title)
    except KeyboardInterrupt:  # the launcher ends all ranks
        raise
    except BaseException as error:  # the other ranks would wait for this one
        print(f"hexmend: rank {comm.rank} failed: {error or type(error).__name__}", file=sys.stderr)
        if not isinstance(error, HexmendError):
            traceback.print_exc()
        sys.stderr.flush()
        comm.Abort(3)
        raise


def _share_processors() -> None:
    """Share the processors of a machine among its ranks, unless the threads of each are given."""
    if os.environ.get("HEXMEND_THREADS") or os.environ.get("OMP_NUM_THREADS"):
        return
    free, whole = cores(), os.cpu_count() or 1
    set_threads(free if free < whole else max(whole // _local_ranks(), 1))


def _local_ranks() -> int:
    """Return the number of ranks on this machine."""
    return next((int(os.environ[name]) for name in _LOCAL_SIZES if os.environ.get(name, "").isdecimal()), 1)


def _prepare(args: argparse.Namespace, method: object) -> Mesh:
    """Read the mesh, and check what can be checked before the run."""
    for name in _SINGLE:
        if getattr(args, name):
            option = f"--{name.replace('_', '-')}"
            raise ParameterError(f"{option} does not work on several MPI ranks yet: run it in one process")
    writer_for(args.output, None if args.rewrite else args.mesh)
    check_targets(args.mesh, args.output, args.json)
    mesh = read(args.mesh, as_is=args.as_is)
    print_notes(mesh)
    print_problems(args.mesh, mesh)
    MeshOutput(args.output, args.mesh, mesh, args.rewrite).warn_of_losses(mesh)
    mesh = with_rules(mesh, motion_rules(args))
    check_distributed(method, mesh)
    return ShapeWatch(mesh, measure(mesh.points, mesh.hexes)).with_target(method)


def _iterate(args: argparse.Namespace, run: RankRun, checkpoints: Checkpoints) -> None:
    """Iterate to the end; rank 0 prints a line every few seconds, and writes checkpoints."""
    ranks, due = run.part.ranks, monotonic() + LINE_INTERVAL
    for now in run:
        if ranks.any(ranks.number == 0 and checkpoints.due):
            given = _Given(args)
            points = gather_points(run.part, run.points, given.points)
            if ranks.number == 0:
                checkpoints.write(lambda given=given, points=points: given.mesh.with_points(points))
        if ranks.number == 0 and monotonic() >= due:
            text = f"{now.inverted:,} inverted, q min {now.q_min:.4f}, q mean {now.q_mean:.4f}, move {run.move:.2g}"
            print(f"iteration {run.number:,}, {run.seconds:.0f} s: {text}", file=sys.stderr, flush=True)
            due = monotonic() + LINE_INTERVAL


def _message(run: RankRun, summaries: Sequence[Summary], peak: float) -> str:
    """Say how the run ended, what it took and what is worse; `peak` is the largest memory of a rank, MiB."""
    kept = "" if run.kept == run.number else f"Iteration {run.kept:,} was kept."
    where = f"on {run.part.ranks.count:,} ranks, each with at most {format_bytes(int(peak * 2**20))} of memory"
    spent = f"{count_phrase(run.number, 'iteration')} in {run.seconds:.3g} s {where}."
    words = run.outcome.value, spent, *run.decisions, kept, describe_regressions(*summaries, None)
    return " ".join(filter(None, words))


def _record(
    run: RankRun, summaries: Sequence[Summary], message: str, of_ranks: Sequence[tuple[float, int]]
) -> dict[str, object]:
    """Return the report of --json, with the peak of memory, MiB, and the threads of each rank."""
    before, after = summaries
    return {
        "method": run.smoother.name,
        "parameters": run.smoother.values(),
        "outcome": run.outcome.key,
        "message": message,
        "iterations": run.number,
        "kept": run.kept,
        "seconds": run.seconds,
        "before": before.to_dict(),
        "after": after.to_dict(),
        "ranks": {"peak_mb": [peak for peak, _ in of_ranks], "threads": [count for _, count in of_ranks]},
    }


class _Given:
    """The mesh as given, which rank 0 reads again when it is needed."""

    def __init__(self, args: argparse.Namespace):
        self._args, self._mesh = args, None

    @property
    def mesh(self) -> Mesh:
        if self._mesh is None:
            self._mesh = read(self._args.mesh, as_is=self._args.as_is)
        return self._mesh

    def points(self) -> object:
        return self.mesh.points


def _finish(args: argparse.Namespace, run: RankRun, checkpoints: Checkpoints, title: str) -> int:
    """Gather the result on rank 0, which writes it and prints the change."""
    ranks, given = run.part.ranks, _Given(args)
    points = gather_points(run.part, run.best_points, given.points)
    peaks, inverted = ranks.comm.gather((peak_mb(), threads())), None
    if ranks.number == 0:
        mesh = given.mesh
        result = mesh.with_points(points)
        written = MeshOutput(args.output, args.mesh, mesh, args.rewrite).write(result)
        checkpoints.remove()
        rules = motion_rules(args)
        summaries = [summarise(with_rules(one, rules)) for one in (mesh, result)]
        print_summaries(f"{args.mesh}: {title}", ["before", "after"], summaries, None)
        message = _message(run, summaries, max(peak for peak, _ in peaks))
        if args.json:
            write_json(args.json, _record(run, summaries, message, peaks))
        print(message)
        print(written)
        inverted = summaries[1].inverted
    return 4 if run.part.ranks.comm.bcast(inverted) else 0
