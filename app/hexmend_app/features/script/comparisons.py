"""Names of comparisons and their rows in a script; a new comparison is added with the lines that create it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from hexmend.iteration import Outcome
from hexmend.mesh.rules.resolution import with_more_rules
from hexmend.quality import summarise
from hexmend.smoothers import METHODS
from hexmend.study import compare
from hexmend.study.table_row import Row
from hexmend_app.features.script.lines import ScriptLines, call
from hexmend_app.features.script.session_contents import SessionContents
from hexmend_app.features.script.source_code import source_of
from hexmend_app.state.mesh.document import State
from hexmend_app.state.run.comparison import ComparisonData
from hexmend_app.state.session.session import Session

#: Outcomes that depend on the time at which a run was ended.
_BY_CLOCK = (Outcome.STOPPED.key, Outcome.MAX_SECONDS.key)


class Comparisons:
    """Names of comparisons in the script.

    Parameters
    ----------
    session : Session
    lines : ScriptLines
    mesh : callable
        Returns the name of a state's mesh in the script.
    contents : SessionContents
    """

    def __init__(self, session: Session, lines: ScriptLines, mesh: Callable[[State], str], contents: SessionContents):
        self._comparison, self._lines, self._mesh, self._contents = session.comparison, lines, mesh, contents
        self.clear()

    def clear(self) -> None:
        """Forget all names."""
        self._last: tuple[object, str] = (), ""
        self._count = 0

    def name(self) -> str:
        """Return the name of the last comparison in the script."""
        results = self._comparison.results
        if self._last[0] is not results:
            source = self._contents.comparison(results) or self._compare(self._comparison.to_data())
            self._last = results, f"comparison_{self._count}"
            self._count += 1
            self._lines.put("Comparison", f"{self._last[1]} = {source}")
        return self._last[1]

    def row(self, row: Row) -> str:
        """Return the script's expression for a row of the last comparison."""
        rows = self._comparison.to_data().rows
        return f"{self.name()}.rows[{next(k for k, other in enumerate(rows) if other is row)}]"

    def mesh(self, row: Row) -> str:
        """Return the script's expression for the mesh of a row, without the rules of motion of the comparison."""
        mesh, data = f"{self.row(row)}.mesh", self._comparison.to_data()
        return f"{self._mesh(data.initial)}.with_points({mesh}.points)" if data.rules else mesh

    def row_of(self, state: State) -> Row | None:
        """Return the row of the method that produced a state, or None."""
        return next((result.row for result in self._comparison.results if result.state is state), None)

    def _compare(self, data: ComparisonData) -> str:
        """Return the source that repeats the comparison; interrupted methods are limited to their iterations."""
        base, stop = self._mesh(data.initial), replace(data.stop, max_seconds=0.0)
        if data.rules:
            base = call(self._lines.use(with_more_rules), [base, self._lines.source(data.rules)])
        function = self._lines.use(compare.compare)
        methods = [source_of(METHODS[row.method](**row.parameters)) for row in data.rows]
        if not data.interrupted and not any(row.outcome in _BY_CLOCK for row in data.rows):
            return call(function, [base, f"[{', '.join(methods)}]", source_of(stop)])
        rows = []
        for method, row in zip(methods, data.rows, strict=True):
            limits = replace(stop, max_iterations=row.iterations) if row.outcome in _BY_CLOCK else stop
            rows.append(f"    *{function}({base}, [{method}], {source_of(limits)}).rows,")
        arguments = [base, f"{self._lines.use(summarise)}({base})", source_of(stop), "\n".join(["(", *rows, ")"])]
        arguments += ["interrupted=True"] if data.interrupted else []
        return call(self._lines.use(compare.Comparison), arguments)
