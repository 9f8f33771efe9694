"""Result of an experiment of the thesis."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from benchmarks.thesis.experiments import INITIAL, Experiment
from hexmend.energy.norm import ObjectiveNorm
from hexmend.iteration import Outcome
from hexmend.mesh.mesh import Mesh
from hexmend.quality import Summary
from hexmend.smoothers import METHODS
from hexmend.study.compare import Row, common_norm, initial_record

#: Objectives of one optimum differ by less than this share, because of the tolerance of A.1.
SAME_OBJECTIVE = 1e-3


@dataclass(frozen=True, eq=False)
class ExperimentResult:
    """Experiment with measured figures.

    Parameters
    ----------
    experiment : Experiment
    mesh : Mesh
        Mesh of the gallery.
    initial : Summary
        Summary of that mesh.
    rows : mapping of str to Row
        Row of each column; the method of the start, if there is one, is the first.
    """

    experiment: Experiment
    mesh: Mesh
    initial: Summary
    rows: Mapping[str, Row]

    @property
    def start(self) -> Summary:
        """Summary of the mesh from which the methods start."""
        first = self.rows.get(self.experiment.start)
        return first.after if first is not None and first.after is not None else self.initial

    def _arrivals(self, norm: ObjectiveNorm) -> dict[str, bool]:
        """Return by the name of each optimiser that ran whether it converged to the optimum."""
        ran = {
            name: row
            for name, row in self.rows.items()
            if row.after is not None and row.method in METHODS and METHODS[row.method].optimises
        }
        objectives = {name: row.objective_by(norm) for name, row in ran.items()}
        best = min((one for one in objectives.values() if one is not None), default=0.0)
        return {
            name: row.outcome == Outcome.CONVERGED.key
            and objectives[name] is not None
            and objectives[name] <= (1 + SAME_OBJECTIVE) * best
            for name, row in ran.items()
        }

    def record(self) -> dict[str, Any]:
        """Return the experiment for JSON, with measured figures as "columns" and those of the thesis as "published"."""
        experiment, norm = self.experiment, common_norm(self.rows.values())
        columns = {name: row.record(norm) for name, row in self.rows.items()}
        for name, there in self._arrivals(norm).items():
            columns[name]["arrived"] = there
        if experiment.start == INITIAL:
            columns = {INITIAL: initial_record(self.mesh, self.initial, norm)} | columns
        return {
            **{key: getattr(experiment, key) for key in ("table", "thesis_mesh", "mesh", "start", "delta")},
            **{key: getattr(self.initial, key) for key in ("hexes", "free_nodes", "nodes")},
            "inverted": self.start.inverted,
            "thesis": {key: getattr(experiment, key) for key in ("hexes", "free_nodes", "inverted")},
            "columns": columns,
            "published": {name: dict(figures) for name, figures in experiment.published.items()},
        }
