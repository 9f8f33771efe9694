"""What section 5.2 of the thesis hopes of work to come, tried: methods with many values, and how fast each arrives."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from hexmend.gallery import make
from hexmend.mesh.mesh import Mesh
from hexmend.quality import Summary, summarise
from hexmend.run import Run, StoppingCriteria
from hexmend.smoothers import METHODS, Smoother
from hexmend.study.table_row import Row, Watch, run_one

#: A run has arrived with its first iteration whose objective is above the optimum by less than this share of it.
NEAR = 1e-3


@dataclass(frozen=True)
class Outlook:
    """One of the thesis's hopes on one mesh; `thesis.toml` explains the fields."""

    section: str
    title: str
    mesh: str
    size: int
    quick: int
    methods: tuple[str, ...]
    vary: Mapping[str, tuple[Any, ...]]
    beside: tuple[str, ...] = ()

    def build(self, quick: bool) -> Mesh:
        """The mesh."""
        return make(self.mesh, size=self.quick if quick else self.size)

    def variants(self) -> list[tuple[Smoother, Mapping[str, Any]]]:
        """Every method to be run, with the values that make it this one among the others."""
        alone: list[tuple[Smoother, Mapping[str, Any]]] = [(METHODS[name](), {}) for name in self.beside]
        combined = [dict(zip(self.vary, values, strict=True)) for values in itertools.product(*self.vary.values())]
        return alone + [(METHODS[name](**values), values) for name in self.methods for values in combined]


@dataclass(frozen=True)
class Point:
    """A run after one of its iterations.

    Parameters
    ----------
    iteration : int
    seconds : float
    objective : float or None
        None while any hex is inverted.
    evaluations : float or None
        How often a hex was asked for its energy or for the derivatives of it, on average; None where the method does
        not say.
    """

    iteration: int
    seconds: float
    objective: float | None
    evaluations: float | None


@dataclass(frozen=True, eq=False)
class Variant:
    """A run with some values, and its way.

    Parameters
    ----------
    values : mapping
        Those that the experiment varies.
    row : Row
    way : tuple of Point
        One an iteration.
    """

    values: Mapping[str, Any]
    row: Row
    way: tuple[Point, ...]

    def arrival(self, optimum: float) -> Point | None:
        """Where its objective was first `NEAR` the optimum; None where it never was."""
        near = (point for point in self.way if point.objective is not None and point.objective < (1 + NEAR) * optimum)
        return next(near, None)

    def record(self, optimum: float | None) -> dict[str, Any]:
        """The run for other programs, with its arrival as `near_iterations`, `near_evaluations`, `near_seconds`."""
        point = self.arrival(optimum) if optimum is not None else None
        return {
            "method": self.row.method,
            **self.values,
            "near_iterations": point and point.iteration,
            "near_evaluations": point and point.evaluations,
            "near_seconds": point and point.seconds,
            "iterations": self.row.iterations,
            "evaluations": self.way[-1].evaluations if self.way else None,
            "seconds": self.row.seconds,
            "objective": self.row.after and self.row.after.objective,
            "inverted": self.row.after and self.row.after.inverted,
            "outcome": self.row.outcome,
            "message": self.row.message,
        }


@dataclass(frozen=True, eq=False)
class TrialResult:
    """What an outlook gave.

    Parameters
    ----------
    outlook : Outlook
    initial : Summary
        Of the mesh.
    variants : tuple of Variant
        In the order of `Outlook.variants`; an interruption leaves out the last.
    """

    outlook: Outlook
    initial: Summary
    variants: tuple[Variant, ...]

    @property
    def optimum(self) -> float | None:
        """The least objective that any run ended with."""
        ends = [one.row.after.objective for one in self.variants if one.row.after is not None]
        return min((end for end in ends if end is not None), default=None)

    def find(self, method: str, **values: Any) -> Variant | None:
        """The run of a method with these values."""
        return next((one for one in self.variants if one.row.method == method and one.values == values), None)

    def record(self) -> dict[str, Any]:
        """The experiment for other programs."""
        one = self.outlook
        return {
            "section": one.section,
            "title": one.title,
            "mesh": one.mesh,
            "hexes": self.initial.hexes,
            "free_nodes": self.initial.free_nodes,
            "optimum": self.optimum,
            "near": NEAR,
            "vary": list(one.vary),
            "runs": [variant.record(self.optimum) for variant in self.variants],
        }


def try_outlook(
    outlook: Outlook, stop: Callable[[str], StoppingCriteria], quick: bool, watch: Watch | None = None
) -> tuple[TrialResult, bool]:
    """Run what an outlook asks for.

    Parameters
    ----------
    outlook : Outlook
    stop : callable
        The limits of a run, by its method.
    quick : bool
    watch : callable, optional
        As in `run_one`.

    Returns
    -------
    tried : TrialResult
    go_on : bool
        False where the user ended it.
    """
    mesh = outlook.build(quick)
    variants: list[Variant] = []
    for smoother, values in outlook.variants():
        way = _Way(mesh, watch)
        row, go_on = run_one(mesh, smoother, stop(smoother.name), way)
        variants.append(Variant(values, row, tuple(way.points)))
        if not go_on:
            break
    return TrialResult(outlook, summarise(mesh), tuple(variants)), go_on


@dataclass
class _Way:
    """Writes down a run's iterations as it is watched."""

    mesh: Mesh
    watch: Watch | None
    points: list[Point] = field(default_factory=list)
    asked: int = 0

    def __call__(self, run: Run) -> Any:
        counts = [run.last.diagnostics.get(key) for key in ("energies", "derivatives")]
        evaluations = None
        if None not in counts:
            self.asked += sum(counts)
            evaluations = self.asked / self.mesh.n_hexes
        row = run.history[-1]
        self.points.append(Point(row["iteration"], row["seconds"], row["objective"], evaluations))
        return self.watch(run) if self.watch is not None else None


def outlooks(entries: Sequence[Mapping[str, Any]]) -> tuple[Outlook, ...]:
    """Outlooks from the tables of a TOML file."""
    return tuple(
        Outlook(
            **{
                **entry,
                "methods": tuple(entry["methods"]),
                "vary": {name: tuple(values) for name, values in entry["vary"].items()},
                "beside": tuple(entry.get("beside", ())),
            }
        )
        for entry in entries
    )
