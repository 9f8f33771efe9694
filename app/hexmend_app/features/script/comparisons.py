"""Names of comparisons and their rows in a script; a new comparison gets the lines that create it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from hexmend.iteration import Outcome
from hexmend.quality import summarise
from hexmend.smoothers import METHODS
from hexmend.study import compare
from hexmend.study.table_row import Row
from hexmend_app.features.script.lines import ScriptLines, call
from hexmend_app.features.script.source_code import made
from hexmend_app.features.script.stored import Stored
from hexmend_app.state.mesh.document import State
from hexmend_app.state.run.comparison import ComparisonData
from hexmend_app.state.session.session import Session

#: Outcomes of a run that hang on when it was ended, not on what it found.
_BY_CLOCK = (Outcome.STOPPED.key, Outcome.MAX_SECONDS.key)


class Comparisons:
    """Tells how methods were compared.

    Parameters
    ----------
    session : Session
    lines : Lines
        The script.
    mesh : callable
        What the script calls the mesh of a state.
    stored : Stored
        Knows what a session holds.
    """

    def __init__(self, session: Session, lines: ScriptLines, mesh: Callable[[State], str], stored: Stored):
        self._now, self._lines, self._mesh, self._stored = session.comparison, lines, mesh, stored
        self.clear()

    def clear(self) -> None:
        """Forget all names."""
        self._last: tuple[object, str] = (), ""
        self._count = 0

    def name(self) -> str:
        """Return the name of the last comparison in the script."""
        results = self._now.results
        if self._last[0] is not results:
            source = self._stored.comparison(results) or self._compare(self._now.to_data())
            self._last = results, f"comparison_{self._count}"
            self._count += 1
            self._lines.put("Comparison", f"{self._last[1]} = {source}")
        return self._last[1]

    def row(self, row: Row) -> str:
        """Return the script's expression for a row of the last comparison."""
        rows = self._now.to_data().rows
        return f"{self.name()}.rows[{next(k for k, one in enumerate(rows) if one is row)}]"

    def row_of(self, state: State) -> Row | None:
        """The row of the method that has made a state; None where that is none's."""
        return next((one.row for one in self._now.results if one.state is state), None)

    def _compare(self, data: ComparisonData) -> str:
        """Return the source that repeats the comparison; interrupted methods are limited to their iterations."""
        base, stop = self._mesh(data.initial), replace(data.stop, max_seconds=0.0)
        function = self._lines.use(compare.compare)
        methods = [made(METHODS[row.method](**row.parameters)) for row in data.rows]
        if not data.interrupted and not any(row.outcome in _BY_CLOCK for row in data.rows):
            return call(function, [base, f"[{', '.join(methods)}]", made(stop)])
        rows = []
        for method, row in zip(methods, data.rows, strict=True):
            own = replace(stop, max_iterations=row.iterations) if row.outcome in _BY_CLOCK else stop
            rows.append(f"    *{function}({base}, [{method}], {made(own)}).rows,")
        several = "\n".join(["(", *rows, ")"])
        words = [base, f"{self._lines.use(summarise)}({base})", made(stop), several]
        words += ["interrupted=True"] if data.interrupted else []
        return call(self._lines.use(compare.Comparison), words)
