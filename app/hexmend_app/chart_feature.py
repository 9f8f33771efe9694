"""Base class of the features whose chart can be saved."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import ClassVar

from hexmend.io.storage.suffixes import suffix_for
from hexmend_app.feature import Feature
from hexmend_app.host import Host
from hexmend_app.report.charts import FIGURE_SUFFIXES, ChartStyle, write_chart
from hexmend_app.report.convergence import Convergence
from hexmend_app.report.histogram import Histogram
from hexmend_app.translation import tr
from hexmend_app.widgets.dialogs.chart_dialog import ChartDialog, answer


class ChartFeature(Feature):
    """Feature that saves its chart as a figure, in the style used last, or its values as CSV.

    Attributes
    ----------
    chart_title, chart_subject, values_title : str
        Names of the chart, of the chart in sentences, and of its values.
    """

    chart_title: ClassVar[str]
    chart_subject: ClassVar[str]
    values_title: ClassVar[str]

    def __init__(self, host: Host):
        super().__init__(host)
        self._style = ChartStyle()

    def described(self) -> Convergence | Histogram:
        """Return the chart for print."""
        raise NotImplementedError

    def write_values(self, path: Path, names: Mapping[str, str]) -> None:
        """Write the values as CSV, with other `names` of their columns."""
        raise NotImplementedError

    def ask(self) -> None:
        """Ask for the style and the file of the chart, and write it."""
        if chosen := answer(self.dialog()):
            path, self._style = chosen
            self.save(path, self._style)

    def dialog(self) -> ChartDialog:
        """Return the dialog that saves the chart, with the style used last."""
        name = f"{self.host.default_file_stem}-{self.chart_title.lower()}.svg"
        kinds = f"SVG figure (*.svg);;PDF figure (*.pdf);;PNG picture (*.png);;{tr(self.values_title)} (*.csv)"
        return ChartDialog(self.described(), tr(self.chart_subject), name, kinds, self._style, self.host.dialog_parent)

    def save(self, path: str | Path, style: ChartStyle | None = None) -> bool:
        """Write the chart, or its values if the suffix is .csv; return True if it was written."""
        return self.write_file(tr(self.chart_title), path, lambda at: self._write(at, style or ChartStyle()))

    def _write(self, path: Path, style: ChartStyle) -> None:
        if suffix_for(path, "a chart", (*FIGURE_SUFFIXES, ".csv")) == ".csv":
            self.write_values(path, style.names)
        else:
            write_chart(path, self.described().draw, style)
