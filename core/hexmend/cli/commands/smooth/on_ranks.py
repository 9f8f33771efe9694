"""`mpiexec -n P hexmend smooth`: a mesh that is divided among P processes."""

from __future__ import annotations

import argparse
import os
import sys
import traceback
from collections.abc import Sequence
from importlib import import_module
from time import monotonic
from typing import TYPE_CHECKING

import numpy as np

from hexmend.arrays import as_immutable
from hexmend.cli.arguments.checks import check_memory, check_targets
from hexmend.cli.arguments.run_arguments import method_and_limits, motion_rules
from hexmend.cli.commands.smooth.checkpoint import Checkpoints
from hexmend.cli.commands.smooth.rank_result import RankResult
from hexmend.cli.output.mesh_messages import print_notes, print_problems
from hexmend.cli.output.mesh_output import MeshOutput
from hexmend.cli.output.progress import LINE_INTERVAL
from hexmend.cli.output.text_tables import print_summaries
from hexmend.errors import HexmendError, ParameterError
from hexmend.io import read, writer_for
from hexmend.iteration import Iteration
from hexmend.kernels import cores, set_threads, threads
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.rules.resolution import with_rules
from hexmend.quality import measure, measure_against_target
from hexmend.ranks.rank_part import distribute
from hexmend.ranks.rank_run import RankRun, gather_points
from hexmend.ranks.rank_sliding import distribute_sliding
from hexmend.ranks.rank_stages import check_distributed
from hexmend.report import write_json
from hexmend.run.memory import peak_mb
from hexmend.run.recipe import Stage
from hexmend.run.shape_watch import ShapeWatch
from hexmend.run.stage_run import StageRun
from hexmend.smoothers import Smoother
from hexmend.smoothers.mend.stages import Stages

if TYPE_CHECKING:
    from mpi4py import MPI

#: Variables in which launchers tell each process the number of processes on its machine.
_LOCAL_SIZES = "OMPI_COMM_WORLD_LOCAL_SIZE", "MPI_LOCALNRANKS"
#: Options that need the whole run in one process.
_SINGLE = "recipe", "surface", "ridges", "only", "rings", "save_recipe", "history"


def run(args: argparse.Namespace) -> int:
    """Smooth a mesh on all ranks of the program; rank 0 reads and writes. Returns 4 if hexes are still inverted."""
    if _local_ranks() >= (os.cpu_count() or 1):  # ranks that wait leave the processor to others
        os.environ.setdefault("OMPI_MCA_mpi_yield_when_idle", "1")
    comm = import_module("mpi4py.MPI").COMM_WORLD  # which begins MPI
    _share_processors()
    source, problem = None, None
    try:
        try:
            method, limits = method_and_limits(args)
            source = _Source(args, method, comm.size) if comm.rank == 0 else None
        except HexmendError as error:
            problem = error
        problems = comm.allgather(None if problem is None else str(problem))
        if any(problems):
            if comm.rank == 0:
                raise problem or HexmendError(next(filter(None, problems)))
            return 3
        part = distribute(comm, None if source is None else source.mesh)
        slides = comm.bcast(source is not None and source.sliding is not None)
        sliding = distribute_sliding(part, None if source is None else source.sliding) if slides else None
        if source is not None:
            source.forget()
        run = RankRun(part, method, limits, sliding)
        _iterate(run, source)
        return _finish(args, run, source, method.title)
    except (KeyboardInterrupt, HexmendError) as error:  # the launcher ends all ranks, or all have ended
        if isinstance(error, KeyboardInterrupt) or any(problems):
            raise
        _abort(comm, error)
    except BaseException as error:
        _abort(comm, error)
    return 3


def _abort(comm: MPI.Comm, error: BaseException) -> None:
    """End all ranks, which would wait for this one."""
    print(f"hexmend: rank {comm.rank} failed: {error or type(error).__name__}", file=sys.stderr)
    if not isinstance(error, HexmendError | MemoryError):
        traceback.print_exception(error)
    sys.stderr.flush()
    comm.Abort(3)


def _share_processors() -> None:
    """Share the processors of a machine among its ranks, unless the threads of each are given."""
    if os.environ.get("HEXMEND_THREADS") or os.environ.get("OMP_NUM_THREADS"):
        return
    free, whole = cores(), os.cpu_count() or 1
    set_threads(free if free < whole else max(whole // _local_ranks(), 1))


def _local_ranks() -> int:
    """Return the number of ranks on this machine."""
    return next((int(os.environ[name]) for name in _LOCAL_SIZES if os.environ.get(name, "").isdecimal()), 1)


class _Source:
    """The mesh of rank 0, which is divided and then kept as it was read; checks everything before the run.

    Attributes
    ----------
    given : Mesh
        As read, without what has been derived from it.
    mesh : Mesh or None
        With the rules of motion and the target of the run, until it is divided.
    sliding : SlidingBoundary or None
        The boundary if it slides, until it is divided.
    output : MeshOutput
    checkpoints : Checkpoints
    """

    def __init__(self, args: argparse.Namespace, method: Smoother, ranks: int):
        for name in _SINGLE:
            if getattr(args, name) not in (None, False, ""):
                option = f"--{name.replace('_', '-')}"
                raise ParameterError(f"{option} does not work on several MPI ranks yet: run it in one process")
        self.checkpoints = Checkpoints(args.output, args.checkpoint)
        writer_for(args.output, None if args.rewrite else args.mesh)
        check_targets(args.mesh, args.output, args.json)
        mesh = read(args.mesh, as_is=args.as_is)
        print_notes(mesh)
        print_problems(args.mesh, mesh)
        self.given = mesh.rebuilt()
        self.output = MeshOutput(args.output, args.mesh, self.given, args.rewrite)
        self.output.warn_of_losses(mesh)
        mesh = with_rules(mesh, motion_rules(args))
        check_distributed(method, mesh)
        check_memory(args, [method], mesh.n_hexes * _local_ranks() // ranks, "use more machines")
        self.mesh = _with_target(mesh, method)
        self.sliding = Stages(method).sliding_boundary(mesh) if method.slides_on(mesh) else None

    def forget(self) -> None:
        """Free what has been divided."""
        self.mesh = self.sliding = None


def _with_target(mesh: Mesh, method: Smoother) -> Mesh:
    """Return a mesh with the target that a method has for its hexes, such as those of boundary layers."""
    return ShapeWatch(mesh, measure(mesh.points, mesh.hexes)).with_target(method)


def _iterate(run: RankRun, source: _Source | None) -> None:
    """Iterate to the end; rank 0 prints a line every few seconds, and writes checkpoints."""
    ranks, due = run.part.ranks, monotonic() + LINE_INTERVAL
    for now in run:
        if ranks.any(source is not None and source.checkpoints.due):
            points = gather_points(run.part, run.points, None if source is None else source.given.points)
            if source is not None:
                source.checkpoints.write(lambda points=points: source.given.with_points(points))
        if source is not None and monotonic() >= due:
            text = f"{now.inverted:,} inverted, q min {now.q_min:.4f}, q mean {now.q_mean:.4f}, move {run.move:.2g}"
            print(f"iteration {run.number:,}, {run.seconds:.0f} s: {text}", file=sys.stderr, flush=True)
            due = monotonic() + LINE_INTERVAL


def _result(mesh: Mesh, points: np.ndarray, run: RankRun, figures: Sequence[tuple[float, int]]) -> RankResult:
    """The result with points (n, 3), from which rank 0 goes on alone where ranks cannot; figures: memory, threads."""
    alone = _finish_alone(mesh, points, run) if run.unsound else None
    result = mesh.with_points(points if alone is None else alone.best.points)
    return RankResult(run, alone, mesh, result, *zip(*figures, strict=True))


def _finish_alone(mesh: Mesh, points: np.ndarray, run: RankRun) -> StageRun:
    """Go on in one process from points (n, 3), where the ranks have left the least scaled Jacobian unsound."""
    print("hexmend: the least scaled Jacobian is not sound: rank 0 raises it alone", file=sys.stderr, flush=True)
    mesh, quality = _with_target(mesh, run.smoother), measure(points, mesh.hexes)
    judged = measure_against_target(mesh, points, quality)
    start = Iteration(run.number, as_immutable(points), quality, run.seconds, 0.0, {}, run.smoother.norm, judged)
    alone = StageRun(mesh, Stage(run.smoother, run.stop), 1, start, start)
    while alone.outcome is None:
        alone.advance()
    return alone


def _finish(args: argparse.Namespace, run: RankRun, source: _Source | None, title: str) -> int:
    """Gather the result on rank 0, which writes it and prints the change."""
    points = gather_points(run.part, run.best_points, None if source is None else source.given.points)
    figures = run.part.ranks.comm.gather((peak_mb(), threads()))
    if source is None:
        return 0  # launchers complain of each process that returns another status
    result = _result(with_rules(source.given, motion_rules(args)), points, run, figures)
    written = source.output.write(source.given.with_points(result.mesh.points))
    source.checkpoints.remove()
    if args.json:
        write_json(args.json, result.record())
    print_summaries(f"{args.mesh}: {title}", ["before", "after"], result.summaries, None)
    for line in filter(None, (result.message, result.surface_sentence, written)):
        print(line)
    return 4 if result.summaries[1].inverted else 0
