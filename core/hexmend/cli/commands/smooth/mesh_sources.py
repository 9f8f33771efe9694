"""Meshes of several ranks: read by rank 0, divided and gathered again, or read, kept and written in parts."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from hexmend.boundary import departures, surface_change
from hexmend.cli.arguments.run_arguments import check_memory, motion_rules, with_surface
from hexmend.cli.commands.smooth.checkpoint import Checkpoints
from hexmend.cli.commands.smooth.rank_result import AgreedError, RankResult, agreed
from hexmend.cli.output.mesh_output import MeshOutput, mid_node_advice, print_losses, print_notes, print_problems
from hexmend.errors import ParameterError
from hexmend.io import read
from hexmend.io.format_lookup import writable_format
from hexmend.io.formats.vtk.pvtu_writer import PieceFiles, names_taken
from hexmend.io.slices import GridSlice, SlicedFile, open_slices, slice_of
from hexmend.iteration import Iteration
from hexmend.layers import named_walls
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.orientation import check_orientation
from hexmend.mesh.rules import MotionRules
from hexmend.mesh.rules.resolution import with_rules
from hexmend.parameters import AUTO
from hexmend.quality import measure, measure_against_target, summarise
from hexmend.ranks.divided.checks import NotDivisibleError, check_divided_orientation, may_have_layers, summarise_part
from hexmend.ranks.divided.divided_mesh import DividedMesh
from hexmend.ranks.divided.reading import divide_slices
from hexmend.ranks.mpi_ranks import local_ranks
from hexmend.ranks.rank_part import distribute, distribute_sliding
from hexmend.ranks.rank_run import RankRun, check_mesh, gather_points
from hexmend.run.recipe import Stage
from hexmend.run.shape_watch import ShapeWatch
from hexmend.run.stage_run import StageRun
from hexmend.smoothers import Smoother
from hexmend.smoothers.mend.stages import Stages

if TYPE_CHECKING:
    from mpi4py import MPI


class WholeSource:
    """Mesh that rank 0 reads, divides and keeps as it was read; all ranks call the methods together.

    Parameters
    ----------
    args : argparse.Namespace
        Of the command.
    method : Smoother
    comm : mpi4py.MPI.Comm
    checkpoints : Checkpoints

    Attributes
    ----------
    part : RankPart
    sliding : RankSliding or None
        The boundary if it slides.
    """

    def __init__(self, args: argparse.Namespace, method: Smoother, comm: MPI.Comm, checkpoints: Checkpoints):
        self._args, self.checkpoints = args, checkpoints
        mesh = agreed(comm, lambda: None if comm.rank else self._read(method, comm.size))
        self.part = distribute(comm, mesh)
        slides = comm.bcast(mesh is not None and method.slides_on(mesh))
        boundary = Stages(method).sliding_boundary(mesh) if slides and mesh is not None else None
        self.sliding = distribute_sliding(self.part, boundary) if slides else None

    def _read(self, method: Smoother, ranks: int) -> Mesh:
        """Read the mesh and check everything before the run; returns it with its rules of motion and its target."""
        args = self._args
        mesh = read(args.mesh, as_is=args.as_is)
        print_notes(mesh)
        print_problems(args.mesh, mesh)
        self._given = mesh.rebuilt()  # as read, without what is derived from it
        self._output = MeshOutput(args.output, args.mesh, self._given, args.rewrite)
        self._output.warn_of_losses(mesh)
        mesh = self._with_motion(self._given, method)
        check_mesh(mesh)
        check_orientation(mesh)
        check_memory(args, [method], mesh.n_elements * local_ranks() // ranks, "use more machines")
        mesh = with_target(mesh, method)
        if mesh.target is None:
            return mesh
        return mesh.keeping_surface().with_points(method.sliding(mesh).mesh.points)  # the boundary begins on it

    def _with_motion(self, mesh: Mesh, method: Smoother) -> Mesh:
        """Return the mesh with the rules of motion and the surface that the options name."""
        return with_surface(self._args, with_rules(mesh, motion_rules(self._args)), method)

    def checkpoint(self, points: np.ndarray) -> None:
        """Write the mesh with points (n, 3) of the nodes of the part."""
        whole = self._gather(points)
        if whole is not None:
            self.checkpoints.write(lambda: self._given.with_points(whole))

    def finish(self, run: RankRun) -> RankResult | None:
        """Gather the result on rank 0, which writes it; returns it there."""
        points = self._gather(run.best_points)
        if points is None:
            return None
        given = self._with_motion(self._given, run.smoother)
        alone = finish_alone(with_target(given, run.smoother), points, run) if run.unsound else None
        mesh = given.with_points(points if alone is None else alone.best.points)
        boundary = None
        if run.smoother.slides_on(given):
            angle, slides = run.smoother.feature_angle, run.smoother.slides
            boundary = surface_change(given, mesh, angle), departures(given, mesh, angle, slides)
        result = self._given.with_points(mesh.points)
        written = self._output.write(result)
        advice = mid_node_advice(self._args.output, result)
        return RankResult(run, alone, (summarise(given), summarise(mesh)), boundary, written, advice)

    def _gather(self, points: np.ndarray) -> np.ndarray | None:
        whole = None if self.part.ranks.number else self._given.points
        return gather_points(self.part, points, whole)


def with_target(mesh: Mesh, method: Smoother) -> Mesh:
    """Return a mesh with the target that a method has for its hexes, such as those of boundary layers."""
    return ShapeWatch(mesh, measure(mesh.points, mesh.elements)).with_target(method)


def finish_alone(mesh: Mesh, points: np.ndarray, run: RankRun) -> StageRun:
    """Go on in one process from points (n, 3), where the ranks have left the minimum scaled Jacobian unsound."""
    print("hexmend: the minimum scaled Jacobian is not sound: rank 0 raises it alone", file=sys.stderr, flush=True)
    points = mesh.with_points(points).points
    quality = measure(points, mesh.elements, mesh.mid_nodes)
    judged = measure_against_target(mesh, points, quality)
    start = Iteration(run.number, points, quality, run.seconds, 0.0, {}, run.smoother.norm, judged)
    alone = StageRun(mesh, Stage(run.smoother, run.stop), 1, start, start)
    while alone.outcome is None:
        alone.advance()
    return alone


if TYPE_CHECKING:
    from mpi4py import MPI


class DividedSource:
    """Mesh that ranks read in slices and write in pieces; all ranks call the methods together.

    Parameters
    ----------
    mesh : DividedMesh
    output : str
        The PVTU file of the result.
    checkpoints : Checkpoints

    Attributes
    ----------
    part : RankPart
    sliding : None
        The boundary is fixed.
    """

    sliding = None

    def __init__(self, mesh: DividedMesh, output: str, checkpoints: Checkpoints):
        self._mesh, self._output, self.checkpoints = mesh, Path(output), checkpoints
        self.part = mesh.part
        self._before = summarise_part(self.part, self.part.mesh.points)

    @classmethod
    def open(
        cls, args: argparse.Namespace, method: Smoother, comm: MPI.Comm, checkpoints: Checkpoints
    ) -> DividedSource | None:
        """Read the mesh, or return None where rank 0 has to read the whole of it, which a message of rank 0 says."""
        if not _suits(args, method):
            return None
        files = agreed(comm, lambda: open_slices(Path(args.mesh)))
        if files is None:
            return None
        try:
            piece, fields = agreed(comm, lambda: _slice(args, method, files, comm)), files[0].field_data
            mesh = agreed(comm, lambda: divide_slices(comm, piece, fields, args.as_is), ParameterError)
            if args.as_is:
                agreed(comm, lambda: check_divided_orientation(mesh))
            if method.keeps_layers and may_have_layers(mesh.part):
                raise NotDivisibleError("it may have boundary layers, which --layers free does not keep")
        except NotDivisibleError as error:
            if not comm.rank:
                print(f"hexmend: rank 0 reads the whole mesh: {error}", file=sys.stderr, flush=True)
            return None
        if not comm.rank:
            print_losses(args.output, names_taken(mesh.node_data, mesh.cells.data))
        return cls(mesh, args.output, checkpoints)

    def checkpoint(self, points: np.ndarray) -> None:
        """Write the mesh with points (n, 3) of the nodes of the part; where that fails, the run goes on."""
        try:
            self._write(self.checkpoints.path, points)
            self.checkpoints.note_written()
        except AgreedError as error:
            self.checkpoints.note_failure(error.problem, quiet=self.part.ranks.number > 0)

    def finish(self, run: RankRun) -> RankResult | None:
        """Write the result, and return it on rank 0."""
        points, alone = run.best_points, None
        if run.unsound:
            whole = self._mesh.gather(points)
            alone = None if whole is None else finish_alone(whole, whole.points, run)
            points = self._mesh.scatter(None if alone is None else whole.with_points(alone.best.points))
        after = summarise_part(self.part, points)
        self._write(self._output, points)
        if self.part.ranks.number:
            return None
        count = self.part.ranks.count
        written = f"Written to {self._output} in {count} {'piece' if count == 1 else 'pieces'}."
        return RankResult(run, alone, (self._before, after), None, written)

    def _write(self, path: Path, points: np.ndarray) -> None:
        """Write all pieces, then the file that names them; see `agreed` for errors."""
        comm = self.part.ranks.comm
        files = comm.bcast(None if comm.rank else PieceFiles.new(path))
        try:
            agreed(comm, files.make_folder)
            agreed(comm, lambda: self._mesh.write(files, points))
            agreed(comm, lambda: None if comm.rank else self._mesh.finish(files))
        except AgreedError:
            files.discard(comm.rank)
            raise


def _suits(args: argparse.Namespace, method: Smoother) -> bool:
    """Return True if the options need no more than the parts of the mesh."""
    default_target = getattr(method, "target", AUTO) == AUTO and not named_walls(getattr(method, "layers", ""))
    fixed = not method.slides and args.surface is None and motion_rules(args) == MotionRules()
    return default_target and fixed and writable_format(Path(args.output), Path(args.mesh)).name == "pvtu"


def _slice(args: argparse.Namespace, method: Smoother, files: Sequence[SlicedFile], comm: MPI.Comm) -> GridSlice:
    """Read the slice of this rank, once the memory is known to suffice."""
    n_cells = sum(file.n_cells for file in files)
    check_memory(args, [method], n_cells * local_ranks() // comm.size, "use more machines")
    return slice_of(files, comm.rank, comm.size)
