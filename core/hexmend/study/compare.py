"""Comparison of methods on one mesh: the tables of the thesis."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from hexmend.mesh.mesh import Mesh
from hexmend.quality import Summary, summarise
from hexmend.run import StoppingCriteria
from hexmend.run.recipe import Recipe
from hexmend.smoothers import METHODS, Smoother
from hexmend.study.table_row import Row, Watch, common_norm, initial_record, run_one


@dataclass(frozen=True, eq=False)
class Comparison:
    """Results of methods on one mesh.

    Parameters
    ----------
    mesh : Mesh
        The mesh as given.
    initial : Summary
        Summary of that mesh.
    stop : StoppingCriteria
        Limits of the runs.
    rows : tuple of Row
        One for each method, in order; methods that were not run after an interruption have none.
    interrupted : bool
        The user ended it before the last method was done.
    """

    mesh: Mesh
    initial: Summary
    stop: StoppingCriteria
    rows: tuple[Row, ...]
    interrupted: bool = False

    def record(self) -> dict[str, Any]:
        """Return the comparison for JSON and for the tables of `hexmend.report`.

        All rows have the objective of the first method that minimises one.
        """
        norm = common_norm(self.rows)
        return {
            "mesh": self.mesh.name,
            "stop": self.stop.values(),
            "interrupted": self.interrupted,
            "initial": initial_record(self.mesh, self.initial, norm),
            "rows": [row.record(norm) for row in self.rows],
        }


def compare(
    mesh: Mesh,
    methods: Iterable[Smoother | Recipe | str] = METHODS,
    stop: StoppingCriteria | None = None,
    *,
    watch: Watch | None = None,
) -> Comparison:
    """Run methods on a mesh, each from the mesh as given.

    A method that fails has a row, and the others are run. KeyboardInterrupt, or `watch` returning False, stops the
    running method and skips the others.

    Parameters
    ----------
    mesh : Mesh
    methods : iterable of Smoother, Recipe or str
        A name stands for the method with default values; `hexmend.study.method_spec.parse_methods` reads settings from
        text. All registered methods by default.
    stop : StoppingCriteria, optional
        Limits of each run; a recipe has its own.
    watch : callable, optional
        See `hexmend.study.table_row.Watch`.

    Returns
    -------
    Comparison

    Examples
    --------
    >>> from hexmend.gallery import make
    >>> answer = compare(make("bridge-sharp", size=864), ["laplacian", "local-sd"], StoppingCriteria(keep_last=True))
    >>> [row.after.inverted > 0 for row in answer.rows]
    [True, False]
    >>> answer.rows[0].worse
    ('inverted', 'invalid', 'q_min', 'scaled_jacobian')
    """
    stop = stop or StoppingCriteria()
    smoothers = [METHODS[method]() if isinstance(method, str) else method for method in methods]
    rows: list[Row] = []
    interrupted = False
    try:
        for smoother in smoothers:
            row, completed = run_one(mesh, smoother, stop, watch)
            rows.append(row)
            if not completed:
                interrupted = True
                break
    except KeyboardInterrupt:  # between two runs
        interrupted = True
    return Comparison(mesh, summarise(mesh), stop, tuple(rows), interrupted)
