"""Mesh that is read, kept and written in parts, one for each rank."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from hexmend.cli.arguments.run_arguments import check_memory, motion_rules
from hexmend.cli.commands.smooth.checkpoint import Checkpoints
from hexmend.cli.commands.smooth.rank_result import AgreedError, RankResult, agreed
from hexmend.cli.commands.smooth.whole_source import finish_alone
from hexmend.cli.output.mesh_output import print_losses
from hexmend.errors import ParameterError
from hexmend.io.format_lookup import writable_format
from hexmend.io.formats.vtk.pvtu_writer import PieceFiles, names_taken
from hexmend.io.slices import GridSlice, SlicedFile, open_slices, slice_of
from hexmend.layers import named_walls
from hexmend.mesh.rules import MotionRules
from hexmend.parameters import AUTO
from hexmend.ranks.divided.checks import NotDivisibleError, check_orientation, may_have_layers, summarise_part
from hexmend.ranks.divided.divided_mesh import DividedMesh
from hexmend.ranks.divided.reading import divide_slices
from hexmend.ranks.mpi_ranks import local_ranks
from hexmend.ranks.rank_run import RankRun
from hexmend.smoothers import Smoother

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
                agreed(comm, lambda: check_orientation(mesh))
            if method.keeps_layers and may_have_layers(mesh.part):
                raise NotDivisibleError("it may have boundary layers, which --layers off does not keep")
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
