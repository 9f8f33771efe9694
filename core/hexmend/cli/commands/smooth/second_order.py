"""Change of hexes of second order by `smooth`, and what repairs them."""

from __future__ import annotations

import shlex
from dataclasses import dataclass

from hexmend.doctor import PROBLEMS
from hexmend.mesh.mesh import Mesh
from hexmend.quality import SecondOrderSummary, summarise_second_order


@dataclass(frozen=True)
class SecondOrderChange:
    """Hexes of second order before and after a run, None where there are none.

    Parameters
    ----------
    before, after : SecondOrderSummary or None
    advice : str
        Sentences about hexes that are invalid between sound corners, and the command that repairs them; "" if none is.
    """

    before: SecondOrderSummary | None
    after: SecondOrderSummary | None
    advice: str

    @classmethod
    def of(cls, given: Mesh, result: Mesh, path: str) -> SecondOrderChange:
        """Summarise the mesh as given and the result, which is written to `path`."""
        before, after = summarise_second_order(given), summarise_second_order(result)
        return cls(before, after, _advice(path, result) if after is not None and after.invalid else "")

    @property
    def lines(self) -> list[str]:
        """Lines about the mesh before and after."""
        summaries = ("before", self.before), ("after", self.after)
        return [f"Second order, {time}: {summary.phrase}." for time, summary in summaries if summary is not None]

    def add_to(self, report: dict[str, object]) -> None:
        """Add the figures to "before" and "after" of a report for --json."""
        for time, summary in (("before", self.before), ("after", self.after)):
            if summary is not None:
                report[time]["second_order"] = summary.to_dict()


def _advice(path: str, mesh: Mesh) -> str:
    found = PROBLEMS["mid-nodes"].find(mesh)
    if found is None:
        return ""
    repair = f"Next: hexmend repair {shlex.quote(path)} -o OUT --only {found.kind}" if found.mendable else ""
    return f"Not fit for solving: {found.message} {found.remedy} {repair}".rstrip()
