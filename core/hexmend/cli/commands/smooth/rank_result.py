"""Result of a run on several ranks, as rank 0 reports it.

Errors of one rank that all ranks have to know.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeVar

from hexmend.boundary import Departures, SurfaceChange
from hexmend.errors import HexmendError
from hexmend.quality import Summary, describe_regressions
from hexmend.ranks.rank_run import RankRun
from hexmend.run.memory import format_bytes
from hexmend.run.messages import kept_message
from hexmend.run.stage_run import StageRun
from hexmend.terminal_text import count_phrase

if TYPE_CHECKING:
    from mpi4py import MPI

T = TypeVar("T")


class AgreedError(Exception):
    """Error that all ranks know.

    Parameters
    ----------
    problem : HexmendError
        That of this rank, or else of another.
    """

    def __init__(self, problem: HexmendError):
        super().__init__(str(problem))
        self.problem = problem


def agreed(comm: MPI.Comm, act: Callable[[], T], expected: type[HexmendError] = HexmendError) -> T:
    """Call a function on each rank, and return its result if it fails on none; all ranks call this together.

    Parameters
    ----------
    comm : mpi4py.MPI.Comm
    act : callable
        What it does together with other ranks is done when it raises.
    expected : type
        Errors on which ranks agree; others are raised at once.

    Raises
    ------
    AgreedError
        On all ranks, if it fails on any.
    """
    problem: HexmendError | None = None
    try:
        result = act()
    except expected as error:
        problem = error
    problems = comm.allgather(None if problem is None else str(problem))
    if any(problems):
        raise AgreedError(problem or HexmendError(next(filter(None, problems))))
    return result


@dataclass(frozen=True, eq=False)
class RankResult:
    """Result of a run on several ranks.

    Parameters
    ----------
    run : RankRun
    alone : StageRun or None
        With which rank 0 went on alone, if it did.
    summaries : (Summary, Summary)
        Figures of the mesh before and after.
    boundary : (SurfaceChange, Departures) or None
        Change of the boundary, and the nodes that have left it; None where it was fixed.
    written : str
        Sentence about the file of the mesh.
    advice : str
        What repairs hexes of second order that are invalid between sound corners; "" where there are none.
    peaks_mb : sequence of float
        Largest memory of each rank, MiB.
    threads : sequence of int
        Of each rank.
    """

    run: RankRun
    alone: StageRun | None
    summaries: tuple[Summary, Summary]
    boundary: tuple[SurfaceChange, Departures] | None
    written: str
    advice: str = ""
    peaks_mb: Sequence[float] = ()
    threads: Sequence[int] = ()

    @property
    def message(self) -> str:
        """Outcome of the run, its cost, and the figures that are worse, in sentences."""
        run, alone = self.run, self.alone
        outcome, decisions, kept, last = run.outcome, run.decisions, run.kept, run.number
        peak = format_bytes(int(max(self.peaks_mb) * 2**20))
        where = f"on {len(self.peaks_mb):,} ranks, each with at most {peak} of memory"
        spent = f"{count_phrase(run.number, 'iteration')} in {run.seconds:.3g} s {where}."
        if alone is not None:
            outcome, decisions = alone.outcome, [*run.decisions, alone.decision]
            kept, last = alone.best.number, alone.last.number
            went_on = count_phrase(alone.n_iterations, "iteration")
            spent += f" Rank 0 continued alone for {went_on} and {alone.last.seconds - run.seconds:.3g} s."
        words = [outcome.value, spent]
        if kept == last or (kept and alone is not None):  # else they are of the end
            words += decisions
        words += [kept_message(kept)] if kept < last else []
        return " ".join(filter(None, [*words, describe_regressions(*self.summaries, None)]))

    @property
    def lines(self) -> list[str]:
        """Lines below the table of the figures."""
        advice = "" if self.summaries[1].inverted else self.advice
        surface = " ".join(filter(None, (one.sentence for one in self.boundary or ())))
        return list(filter(None, (self.message, surface, self.written, advice)))

    def record(self) -> dict[str, object]:
        """Return the report of --json, with the peak of memory, MiB, and the threads of each rank."""
        run, alone, (before, after) = self.run, self.alone, self.summaries
        newest = run if alone is None else alone.last
        report = {
            "method": run.smoother.name,
            "parameters": run.smoother.values(),
            "outcome": (run if alone is None else alone).outcome.key,
            "message": self.message,
            "iterations": newest.number,
            "kept": run.kept if alone is None else alone.best.number,
            "seconds": newest.seconds,
            "before": before.to_dict(),
            "after": after.to_dict(),
            "ranks": {
                "peak_mb": list(self.peaks_mb),
                "threads": list(self.threads),
                "iterations_alone": 0 if alone is None else alone.n_iterations,
            },
        }
        if self.boundary is not None:
            change, left = self.boundary
            report["surface"] = change.to_dict() | {"left": left.to_dict()}
        return report
