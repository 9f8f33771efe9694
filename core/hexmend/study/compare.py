"""Several methods on one mesh, one after another: the thesis's tables."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from hexmend.mesh.mesh import Mesh
from hexmend.quality import Summary, summarise
from hexmend.run import StoppingCriteria
from hexmend.run.recipe import Recipe
from hexmend.smoothers import METHODS, Smoother
from hexmend.study.table_row import Row, Watch, common_power, initial_record, run_one


@dataclass(frozen=True, eq=False)
class Comparison:
    """Methods side by side.

    Parameters
    ----------
    mesh : Mesh
        As given.
    initial : Summary
    stop : StoppingCriteria
    rows : tuple of Row
        A row a method, in the order of running; methods that an interruption left out have none.
    interrupted : bool
        Whether the user ended it before the last method was done.
    """

    mesh: Mesh
    initial: Summary
    stop: StoppingCriteria
    rows: tuple[Row, ...]
    interrupted: bool = False

    def record(self) -> dict[str, Any]:
        """The comparison for other programs: what `hexmend.report` makes tables of.

        Its one objective is that of the first method that minimises one.
        """
        power = common_power(self.rows)
        return {
            "mesh": self.mesh.name,
            "stop": self.stop.values(),
            "interrupted": self.interrupted,
            "initial": initial_record(self.mesh, self.initial, power),
            "rows": [row.record(power) for row in self.rows],
        }


def compare(
    mesh: Mesh,
    methods: Iterable[Smoother | Recipe | str] = METHODS,
    stop: StoppingCriteria | None = None,
    *,
    watch: Watch | None = None,
) -> Comparison:
    """Run methods on a mesh, each from the mesh as given.

    A method that fails has its row, and the others go on. KeyboardInterrupt, or `watch` returning False, ends the
    method at work as stopped and leaves out those after it.

    Parameters
    ----------
    mesh : Mesh
    methods : iterable of Smoother, Recipe or str
        Names stand for methods with their defaults; `hexmend.study.method_spec` takes settings in words. All that are
        registered if not given.
    stop : StoppingCriteria, optional
        Limits of each method's run; a recipe has its own.
    watch : callable, optional
        See `Watch`.

    Examples
    --------
    >>> from hexmend.gallery import make
    >>> answer = compare(make("bridge-sharp", size=864), ["laplacian", "local-sd"], StoppingCriteria(keep_last=True))
    >>> [row.after.inverted > 0 for row in answer.rows]
    [True, False]
    >>> answer.rows[0].worse
    ('inverted', 'q_min', 'scaled_jacobian')
    """
    stop = stop or StoppingCriteria()
    smoothers = [METHODS[one]() if isinstance(one, str) else one for one in methods]
    rows: list[Row] = []
    interrupted = False
    try:
        for smoother in smoothers:
            row, go_on = run_one(mesh, smoother, stop, watch)
            rows.append(row)
            if not go_on:
                interrupted = True
                break
    except KeyboardInterrupt:  # between two runs
        interrupted = True
    return Comparison(mesh, summarise(mesh), stop, tuple(rows), interrupted)
