"""Distributions in the histogram: their description as a histogram, their counts as CSV, and the texts about them."""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from hexmend.quality import METRICS
from hexmend_app.picture.visibility import Show
from hexmend_app.report.distribution import Axis, Distribution
from hexmend_app.report.histogram import Histogram, Series
from hexmend_app.scene.colour.colouring import Colouring
from hexmend_app.theme.palette import Role
from hexmend_app.translation import tr
from hexmend_app.widgets.metric_texts import in_sentence
from hexmend_app.widgets.wording import counted, plural


@dataclass(frozen=True, eq=False)
class Shown:
    """Distribution that is shown in the histogram.

    Parameters
    ----------
    name : str
    colour : Role
    distribution : Distribution
    filled : bool
        True for bars, False for an outline.
    """

    name: str
    colour: Role
    distribution: Distribution
    filled: bool = False


@dataclass(frozen=True, eq=False)
class ShownHistogram:
    """Distributions on one axis.

    Parameters
    ----------
    axis : Axis
    shown : sequence of Shown
        In the order of the legend.
    log : bool
        True for logarithmic heights.
    cumulative : bool
        True for shares of hexes up to a value, in percent, instead of numbers of hexes.
    """

    axis: Axis
    shown: Sequence[Shown]
    log: bool = False
    cumulative: bool = False

    @property
    def noun(self) -> str:
        """Word for one of the cells."""
        return self.shown[0].distribution.noun if self.shown else "hex"

    def _scale(self, one: Shown) -> float:
        return 100 / max(one.distribution.total, 1) if self.cumulative else 1.0

    def describe(self, title: str = "", for_print: bool = False, colours: Sequence[str] = ()) -> Histogram:
        """Describe the histogram, to be drawn.

        Parameters
        ----------
        title : str
        for_print : bool
            Use the colours of the light theme instead of those of the current one.
        colours : sequence of str
            Colours of the bars of the filled distributions; cumulative shares have none, they would hide each other.
        """
        series = []
        for one in self.shown:
            inverted, filled = one.distribution.inverted, one.filled and not self.cumulative
            series.append(
                Series(
                    one.name,
                    one.colour.light if for_print else str(one.colour),
                    (one.distribution.counts(self.axis, self.cumulative) * self._scale(one)).tolist(),
                    inverted * self._scale(one),
                    filled,
                    colours if filled else (),
                    tr("{count:,} inverted", count=inverted),
                )
            )
        cells = plural(self.noun)
        label = tr("% of {hexes} up to x", hexes=cells) if self.cumulative else cells
        return Histogram(series, title, self.axis.title, label, self.axis.ticks(), self.log)

    def csv_text(self, names: Mapping[str, str]) -> str:
        """Write the heights as CSV with a row per bin, and a column per distribution; `names` maps to printed names."""
        prefix = tr("% of {hexes} up to: ", hexes=plural(self.noun)) if self.cumulative else ""
        titles = [prefix + (names.get(one.name) or one.name) for one in self.shown]
        low, high = [f"{edge:.7g}" for edge in self.axis.edges[:-1]], [f"{edge:.7g}" for edge in self.axis.edges[1:]]
        low[0], high[-1] = "-inf" if self.axis.below else low[0], "inf" if self.axis.above else high[-1]
        series = self.describe().series
        out = io.StringIO()
        rows = csv.writer(out, lineterminator="\n")
        rows.writerow([f"{self.axis.metric} from", f"{self.axis.metric} to", *titles])
        rows.writerow(["inverted", "inverted", *(f"{one.inverted:.6g}" for one in series)])
        for bin, ends in enumerate(zip(low, high, strict=True)):
            rows.writerow([*ends, *(f"{one.counts[bin]:.9g}" for one in series)])
        return out.getvalue()

    def describe_at(self, x: float) -> str:
        """Describe the bin at a position of the plot, with a line for each distribution; "" if there is none."""
        column = self.describe().column
        if column is not None and column[0] <= x <= column[1]:
            return self._lines(tr("inverted"), [one.distribution.inverted for one in self.shown])
        if not 0 <= x < self.axis.bins:
            return ""
        bin = int(x)
        low, high = (self.axis.text(edge) for edge in self.axis.edges[bin : bin + 2])
        metric = in_sentence(METRICS[self.axis.metric])
        if self.cumulative:
            title = tr("inverted, or {metric} up to {high}", metric=metric, high=high)
        elif self.axis.below and bin == 0:
            title = f"{metric} < {high}"
        elif self.axis.above and bin == self.axis.bins - 1:
            title = f"{metric} ≥ {low}"
        else:
            title = f"{metric} {low} – {high}"
        return self._lines(title, [one.distribution.counts(self.axis, self.cumulative)[bin] for one in self.shown])

    def _lines(self, title: str, counts: Sequence[int]) -> str:
        lines = [title]
        for one, count in zip(self.shown, counts, strict=True):
            share = f"{count * self._scale(one):.4g} %, " if self.cumulative else ""
            lines.append(f"{one.name}: {share}{counted(int(count), self.noun)}")
        return "\n".join(lines)


def range_summary(now: Distribution | None, range: Show | None, inside: int) -> str:
    """Describe the number of hexes in a range; of all hexes and of invalid ones, if it is None."""
    if now is None:
        return tr("No mesh is open.")
    if range is not None:
        return tr("{count:,} of {hexes} shown", count=now.within(range), hexes=counted(now.total, now.noun))
    counts = {"hexes": counted(now.total, now.noun), "inverted": now.inverted, "inside": inside}
    if inside:
        return tr("{hexes}, {inverted:,} inverted · {inside:,} invalid inside", **counts)
    return tr("{hexes}, {inverted:,} inverted", **counts)


def bin_colours(colouring: Colouring, axis: Axis) -> list[str]:
    """Return the colours of the view, #rrggbb, at the middles of the bins of an axis."""
    middles = (axis.edges[:-1] + axis.edges[1:]) / 2
    return [f"#{bytes(colour).hex()}" for colour in colouring.colours(middles, np.zeros(len(middles), bool))]
