"""Experiments as data: mesh, start, methods and published figures."""

from __future__ import annotations

import math
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Any

from benchmarks.thesis.outlook.experiments import Outlook, outlooks
from hexmend.gallery import make
from hexmend.mesh.mesh import Mesh
from hexmend.parameters import declared
from hexmend.run import StoppingCriteria
from hexmend.smoothers import METHODS, Smoother

#: Start from the mesh as generated.
INITIAL = "initial"


@dataclass(frozen=True)
class Experiment:
    """Table of the thesis, or the part of it about one mesh; `thesis.toml` explains the fields."""

    table: str
    thesis_mesh: str
    mesh: str
    size: int
    quick: int
    hexes: int
    free_nodes: int
    inverted: int
    start: str
    columns: tuple[str, ...]
    published: Mapping[str, Mapping[str, float | int]]
    delta: float | None = None
    scramble: float = 0.0
    settings_of: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)
    additional: tuple[str, ...] = ()

    @property
    def methods(self) -> tuple[str, ...]:
        """Methods that run from the start: columns of the table, and additional ones."""
        return (*self.columns[1:], *self.additional)

    def requested_hexes(self, quick: bool) -> int:
        """Return the number of hexes requested from the gallery."""
        return self.quick if quick else self.size

    def build(self, quick: bool) -> Mesh:
        """Build the mesh as generated."""
        return make(self.mesh, size=self.requested_hexes(quick), scramble=self.scramble)


@dataclass(frozen=True)
class Experiments:
    """Experiments with the limits of their runs.

    Parameters
    ----------
    experiments : tuple of Experiment
    iterations : mapping
        Most iterations, by method.
    seconds : mapping
        Most seconds of a run, of the "full" and the "quick" study.
    quick_seconds : mapping
        Most seconds of a run in the quick study, by method, where they differ.
    outlooks : tuple of Outlook
        Experiments of section 5.2.
    settings : mapping
        Values of parameters, for the methods that declare them.
    move, tolerance : str, float
        Criteria of convergence, see `StoppingCriteria`.
    tolerance_of : mapping
        Tolerances by method, where they differ.
    moves_only : bool
        See `StoppingCriteria`.
    repeats : mapping
        Number of "times" that runs are measured which take less than "below" seconds: the least time counts.
    """

    experiments: tuple[Experiment, ...]
    iterations: Mapping[str, int]
    seconds: Mapping[str, float]
    quick_seconds: Mapping[str, float] = field(default_factory=dict)
    outlooks: tuple[Outlook, ...] = ()
    settings: Mapping[str, Any] = field(default_factory=dict)
    move: str = StoppingCriteria().move
    tolerance: float = StoppingCriteria().tolerance
    tolerance_of: Mapping[str, float] = field(default_factory=dict)
    moves_only: bool = StoppingCriteria().moves_only
    repeats: Mapping[str, float] = field(default_factory=lambda: {"times": 1, "below": 0.0})

    def smoother(self, experiment: Experiment, name: str) -> Smoother:
        """Make a method with the settings of the study and the delta of the experiment, as far as it declares them."""
        values = {**self.settings, "delta": experiment.delta, **experiment.settings_of.get(name, {})}
        cls = METHODS[name]
        known = {parameter.name for parameter in declared(cls)}
        return cls(**{key: value for key, value in values.items() if key in known and value is not None})

    def with_max_seconds(self, seconds: float) -> Experiments:
        """Return a copy with another limit of the time of every run."""
        return replace(self, seconds=dict.fromkeys(self.seconds, seconds), quick_seconds={})

    def stop(self, method: str, quick: bool) -> StoppingCriteria:
        """Return the limits of a run; the result is the last iterate, as in the thesis."""
        tolerance = self.tolerance_of.get(method, self.tolerance)
        limits = self.outlook_stop(method, quick)
        return replace(limits, move=self.move, tolerance=tolerance, moves_only=self.moves_only)

    def outlook_stop(self, method: str, quick: bool) -> StoppingCriteria:
        """Return the limits of a run of an outlook, with the default criteria of convergence."""
        limit = self.iterations.get(method, StoppingCriteria().max_iterations)
        seconds = self.quick_seconds.get(method, self.seconds["quick"]) if quick else self.seconds["full"]
        return StoppingCriteria(max_iterations=limit, max_seconds=seconds, keep_last=True)


def load(source: Path | Traversable | None = None) -> Experiments:
    """Read experiments from a TOML file; those of Chapter 4 and section 5.2 of the thesis by default.

    Parameters
    ----------
    source : Path or Traversable, optional

    Returns
    -------
    Experiments

    Examples
    --------
    >>> thesis = load()
    >>> thesis.experiments[0].published["local-sd"]["q_mean"]
    0.8831
    """
    source = source or files("benchmarks.thesis") / "thesis.toml"
    data = tomllib.loads(source.read_text(encoding="utf-8"))
    data["experiments"] = tuple(map(_experiment, data.pop("experiment")))
    data["outlooks"] = outlooks(data.pop("outlook", ()))
    return Experiments(**data)


def _experiment(entry: Mapping[str, Any]) -> Experiment:
    columns = tuple(entry["columns"])
    published: dict[str, dict[str, float | int]] = {column: {} for column in columns}
    for figure, values in entry.get("published", {}).items():
        for column, value in zip(columns, values, strict=True):
            if not math.isnan(value):
                published[column][figure] = value
    additional = tuple(entry.get("additional", ()))
    return Experiment(**{**entry, "columns": columns, "additional": additional, "published": published})
