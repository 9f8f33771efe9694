"""`mpiexec -n P hexmend smooth`: a mesh that is divided among P processes."""

from __future__ import annotations

import argparse
import os
import sys
import traceback
from dataclasses import replace
from importlib import import_module
from time import monotonic
from typing import TYPE_CHECKING

from hexmend.cli.arguments.run_arguments import check_targets, method_and_limits
from hexmend.cli.commands.smooth.checkpoint import Checkpoints
from hexmend.cli.commands.smooth.mesh_sources import DividedSource, WholeSource
from hexmend.cli.commands.smooth.rank_result import AgreedError, agreed
from hexmend.cli.output.text_tables import print_summaries
from hexmend.cli.process.interrupts import ExitAfterIteration
from hexmend.errors import HexmendError, ParameterError
from hexmend.io import writer_for
from hexmend.io.files import check_not_included
from hexmend.kernels import cores, cores_for, release_free_memory, set_threads, threads
from hexmend.ranks.mpi_ranks import local_ranks
from hexmend.ranks.rank_run import RankRun, check_method
from hexmend.report.records import write_json
from hexmend.run import StoppingCriteria
from hexmend.run.memory import peak_mb
from hexmend.run.progress import LINE_INTERVAL
from hexmend.smoothers import Smoother

if TYPE_CHECKING:
    from mpi4py import MPI

#: Options that need the whole run in one process.
_SINGLE = "recipe", "ridges", "only", "rings", "save_recipe", "history"


def run(args: argparse.Namespace) -> int:
    """Smooth a mesh on all ranks of the program. Returns 4 on rank 0 if hexes are still invalid."""
    if local_ranks() >= (os.cpu_count() or 1):  # ranks that wait leave the processor to others
        os.environ.setdefault("OMPI_MCA_mpi_yield_when_idle", "1")
    comm = import_module("mpi4py.MPI").COMM_WORLD  # which begins MPI
    _share_processors()
    try:
        method, limits = agreed(comm, lambda: _checked(args, comm))
        checkpoints = Checkpoints(args.output, args.checkpoint)
        source = DividedSource.open(args, method, comm, checkpoints)
        source = source or WholeSource(args, method, comm, checkpoints)
        release_free_memory()  # of what was read and divided
        run = RankRun(source.part, method, limits, source.sliding)
        _iterate(run, source)
        return _finish(args, run, source, method.title)
    except AgreedError as error:
        if comm.rank == 0:
            raise error.problem from None
    except KeyboardInterrupt:
        raise
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
    set_threads(free if free < whole else cores_for(local_ranks()))


def _checked(args: argparse.Namespace, comm: MPI.Comm) -> tuple[Smoother, StoppingCriteria]:
    """Return the method and its limits, once rank 0 has checked the options and the files to be written."""
    method, limits = method_and_limits(args)
    if comm.rank == 0:
        for name in _SINGLE:
            if getattr(args, name) not in (None, False, ""):
                option = f"--{name.replace('_', '-')}"
                raise ParameterError(f"{option} does not work on several MPI ranks yet: run it in one process")
        check_method(method)
        writer_for(args.output, None if args.rewrite else args.mesh)
        Checkpoints(args.output, args.checkpoint)
        check_not_included(args.output, args.mesh)
        check_targets(args.mesh, args.output, args.json)
    return method, limits


def _iterate(run: RankRun, source: DividedSource | WholeSource) -> None:
    """Iterate to the end or until a rank is asked to end; rank 0 prints a line every few seconds."""
    ranks, due = run.part.ranks, monotonic() + LINE_INTERVAL
    first = ranks.number == 0
    with ExitAfterIteration(quiet=not first) as signals:
        for now in run:
            if ranks.any(first and source.checkpoints.due):
                source.checkpoint(run.points)
            if first and monotonic() >= due:
                text = f"{now.invalid:,} invalid, q min {now.q_min:.4f}, q mean {now.q_mean:.4f}, move {run.move:.2g}"
                print(f"iteration {run.number:,}, {run.seconds:.0f} s: {text}", file=sys.stderr, flush=True)
                due = monotonic() + LINE_INTERVAL
            if ranks.any(signals.asked):
                run.close()
                break


def _finish(args: argparse.Namespace, run: RankRun, source: DividedSource | WholeSource, title: str) -> int:
    """Write the result; rank 0 prints the change."""
    release_free_memory()  # of the run
    result = source.finish(run)
    figures = run.part.ranks.comm.gather((peak_mb(), threads()))
    if result is None:
        return 0  # launchers complain of each process that returns another status
    peaks, numbers = zip(*figures, strict=True)
    result = replace(result, peaks_mb=peaks, threads=numbers)
    source.checkpoints.remove()
    if args.json:
        write_json(args.json, result.record())
    print_summaries(f"{args.mesh}: {title}", ["before", "after"], result.summaries, None)
    for line in result.lines:
        print(line)
    return 4 if result.summaries[1].invalid else 0
