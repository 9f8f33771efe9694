"""Experiments as data: which methods run on which mesh, from which start, and what was published of it."""

from __future__ import annotations

import math
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Any

from hexmend.gallery import make
from hexmend.mesh.mesh import Mesh
from hexmend.run import StoppingCriteria
from hexmend.smoothers import Smoother
from hexmend.study.outlook.experiments import Outlook, outlooks
from hexmend.study.thesis.settings import Settings

#: The start that is no method's.
INITIAL = "initial"


@dataclass(frozen=True)
class Experiment:
    """One of the thesis's tables, or the half of one that is about one mesh; `thesis.toml` explains the fields."""

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
    settings_of: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)
    beside: tuple[str, ...] = ()

    @property
    def methods(self) -> tuple[str, ...]:
        """The columns that are runs from the start, and those that the thesis's table does not have."""
        return (*self.columns[1:], *self.beside)

    def asked(self, quick: bool) -> int:
        """The number of hexes asked of the gallery."""
        return self.quick if quick else self.size

    def build(self, quick: bool) -> Mesh:
        """The mesh before its start."""
        return make(self.mesh, size=self.asked(quick))


@dataclass(frozen=True)
class Experiments:
    """Experiments with the limits of their runs.

    Parameters
    ----------
    experiments : tuple of Experiment
    iterations : mapping
        Most iterations by method.
    seconds : mapping
        Most seconds of a run, of the "full" and the "quick" study.
    quick_seconds : mapping
        Most seconds of a run in the quick study, of methods for which it is another.
    outlooks : tuple of Outlook
        What section 5.2 hopes for.
    settings : Settings
        Of the methods in experiments.
    move, tolerance : str, float
        Of `StoppingCriteria`.
    tolerance_of : mapping
        Tolerances of methods for which it is another.
    """

    experiments: tuple[Experiment, ...]
    iterations: Mapping[str, int]
    seconds: Mapping[str, float]
    quick_seconds: Mapping[str, float] = field(default_factory=dict)
    outlooks: tuple[Outlook, ...] = ()
    settings: Settings = field(default_factory=Settings)
    move: str = StoppingCriteria().move
    tolerance: float = StoppingCriteria().tolerance
    tolerance_of: Mapping[str, float] = field(default_factory=dict)

    def smoother(self, experiment: Experiment, name: str) -> Smoother:
        """A method with the study's settings and the experiment's delta, as far as it has these parameters."""
        delta = {} if experiment.delta is None else {"delta": experiment.delta}
        return self.settings.of(name, **delta, **experiment.settings_of.get(name, {}))

    def limited(self, seconds: float) -> Experiments:
        """The same with another limit of the time of every run."""
        return replace(self, seconds=dict.fromkeys(self.seconds, seconds), quick_seconds={})

    def stop(self, method: str, quick: bool) -> StoppingCriteria:
        """The limits of a run; what the thesis tells of a method is its last iterate."""
        tolerance = self.tolerance_of.get(method, self.tolerance)
        return replace(self.outlook_stop(method, quick), move=self.move, tolerance=tolerance)

    def outlook_stop(self, method: str, quick: bool) -> StoppingCriteria:
        """The same of an outlook, which converges as runs do by default."""
        limit = self.iterations.get(method, StoppingCriteria().max_iterations)
        seconds = self.quick_seconds.get(method, self.seconds["quick"]) if quick else self.seconds["full"]
        return StoppingCriteria(max_iterations=limit, max_seconds=seconds, keep_last=True)


def load(source: Path | Traversable | None = None) -> Experiments:
    """Experiments from a TOML file; the thesis's Chapter 4 and section 5.2 if none is named.

    Examples
    --------
    >>> thesis = load()
    >>> thesis.experiments[0].published["local-sd"]["q_mean"]
    0.8831
    """
    source = source or files("hexmend.study.thesis") / "thesis.toml"
    data = tomllib.loads(source.read_text(encoding="utf-8"))
    experiments = tuple(_experiment(entry) for entry in data["experiment"])
    return Experiments(
        experiments,
        data["iterations"],
        data["seconds"],
        data.get("quick_seconds", {}),
        outlooks(data.get("outlook", ())),
        Settings(data.get("settings", {})),
        data.get("move", StoppingCriteria().move),
        data.get("tolerance", StoppingCriteria().tolerance),
        data.get("tolerance_of", {}),
    )


def _experiment(entry: Mapping[str, Any]) -> Experiment:
    columns = tuple(entry["columns"])
    published: dict[str, dict[str, float | int]] = {column: {} for column in columns}
    for figure, values in entry.get("published", {}).items():
        for column, value in zip(columns, values, strict=True):
            if not math.isnan(value):
                published[column][figure] = value
    beside = tuple(entry.get("beside", ()))
    return Experiment(**{**entry, "columns": columns, "beside": beside, "published": published})
