"""Panel that selects the metric, the map and the range of the colours."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
from PySide6.QtCore import QSize, Signal
from PySide6.QtGui import QIcon, QImage, QPixmap
from PySide6.QtWidgets import QCheckBox, QLabel, QSizePolicy, QWidget

from hexmend.parameters import Parameter
from hexmend.quality import METRICS
from hexmend_app.picture.colour_map import CHANGE_MAP, COLOUR_MAPS, value_maps
from hexmend_app.picture.colours import MATERIAL, Colours, Range, colour_quantity
from hexmend_app.picture.displacement import DISPLACEMENT_QUANTITIES
from hexmend_app.scene.colour.colouring import range_label
from hexmend_app.scene.colour.value_range import declared_range
from hexmend_app.theme.palette import WORSE
from hexmend_app.theme.style import check_box, set_help, show_text, small_label
from hexmend_app.translation import tr
from hexmend_app.widgets.form import form_layout, row_of
from hexmend_app.widgets.inputs.combo import ComboBox, let_shrink
from hexmend_app.widgets.inputs.number_box import NumberBox
from hexmend_app.widgets.inputs.segmented import Segmented
from hexmend_app.widgets.metric_texts import described, metrics_offered
from hexmend_app.widgets.wording import short_number

#: Key of the range between two numbers.
_PINNED = "pinned"
_RANGES = {
    Range.FULL: ("Full", "All possible values of the metric"),
    Range.FITTED: ("Fitted", "Current minimum and maximum, without invalid hexes; follows a running method."),
    Range.ACCEPTABLE: ("Acceptable", "Values that solvers usually accept"),
    _PINNED: ("Pinned", "Limits that you set, initially the current range."),
}
_NEUTRAL = "Draw the boundary white and cut faces in one colour; invalid hexes keep their colours."
_SHADING = "Darken corners and holes when the view is still (ambient occlusion)."
_BOXES = (("low", 0.0), ("high", 1.0))
_SWATCH = QSize(48, 12)
_VALUE_MAPS_HELP = "All maps are perceptually uniform and readable with red-green colour blindness."


class ColourPanel(QWidget):
    """Panel that selects the metric, map and range of the colours.

    Signals
    -------
    colours_changed(Colours)
        The user changed the colours. Limits count once entered, stepped, or left for another field.
    """

    colours_changed = Signal(object)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._colours = Colours()
        self._ends = (0.0, 1.0)  # of the current range
        self._pinned: dict[str, tuple[float, float]] = {}  # limits that the user set, by metric
        self._metric = ComboBox()
        let_shrink(self._metric, 7)
        self._metric.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        for metric in (*metrics_offered(), *DISPLACEMENT_QUANTITIES.values(), MATERIAL):
            self._metric.add(tr(metric.title), described(metric), metric.name)
        self._metric.insertSeparator(len(METRICS))
        self._metric.insertSeparator(self._metric.count() - 1)
        self._map = MapBox()
        self._reverse = QCheckBox("⇅")
        set_help(
            self._reverse, tr("Reverse"), tr("Reverse the colour map. By default the dark end marks the worst values.")
        )
        self._range = Segmented(tr("Range"), [(str(key), tr(text), tr(help)) for key, (text, help) in _RANGES.items()])
        self._low, self._high = (NumberBox(Parameter(n, float, d, None, None, None, "", "")) for n, d in _BOXES)
        set_help(self._low, tr("Minimum value"), tr("Value of the first colour; to set it, select Pinned."))
        set_help(self._high, tr("Maximum value"), tr("Value of the last colour; to set it, select Pinned."))
        self._neutral, self.shading = check_box(tr("Neutral"), tr(_NEUTRAL)), check_box(tr("Shading"), tr(_SHADING))
        self._problem = small_label(colour=WORSE)
        self._problem.hide()
        self._lay_out()

        self._metric.activated.connect(lambda: self.choose_metric(self._metric.currentData()))
        self._map.chosen.connect(lambda name: self._change(map=name))
        self._reverse.clicked.connect(lambda on: self._change(reverse=on))
        self._range.chosen.connect(self._on_range)
        self._neutral.clicked.connect(lambda on: self._change(neutral=on))
        for box in (self._low, self._high):
            box.changed.connect(lambda box=box: self._on_number(box))
            box.editingFinished.connect(self._on_numbers)
        self._refresh()
        self._show_ends()

    def _lay_out(self) -> None:
        form = form_layout(self)
        form.addRow(tr("Colours"), self._metric)
        form.addRow(tr("Map"), row_of((self._map, 1), self._reverse))
        form.addRow(self._range)  # four texts need the whole width
        form.addRow(row_of((self._low, 1), QLabel(tr("to")), (self._high, 1)))
        form.addRow(row_of(self._neutral, 8, self.shading, None))
        form.addRow(self._problem)

    def set_colours(self, colours: Colours) -> None:
        """Show colours; emits no signal."""
        if colours != self._colours:
            self._apply(colours)

    def colours(self) -> Colours:
        """Return the colours shown."""
        return self._colours

    def set_ends(self, low: float, high: float) -> None:
        """Show the ends of the current range, computed from the values; emits no signal."""
        self._ends = (low, high)
        if not self._is_pinned:
            self._show_ends()

    @property
    def _is_pinned(self) -> bool:
        return isinstance(self._colours.range, tuple)

    def choose_metric(self, metric: str) -> None:
        """Select a metric as the user would."""
        if metric == self._colours.metric:
            return
        before, range = self._colours.metric, self._colours.range
        if metric == MATERIAL.name:  # materials have no range; that of the metric stays for the return to it
            if isinstance(range, tuple):
                self._pinned[before] = range
            self._change(metric=metric)
            return
        if (metric in DISPLACEMENT_QUANTITIES) != (before in DISPLACEMENT_QUANTITIES):
            range = Range.FITTED if metric in DISPLACEMENT_QUANTITIES else Range.FULL
        if isinstance(range, tuple):  # limits of one metric mean nothing for another
            range = self._pinned.get(metric, Range.FULL)
        if range in (Range.FULL, Range.ACCEPTABLE) and declared_range(metric, range) is None:
            range = Range.FITTED
        self._change(metric=metric, range=range)

    def _on_range(self, key: str) -> None:
        if key != _PINNED:
            self._change(range=Range(key))
        elif not self._is_pinned:
            self._change(range=self._pinned.get(self._colours.metric) or _rounded(*self._ends))

    def _on_number(self, box: NumberBox) -> None:
        self._show_problem()
        if not box.lineEdit().isModified():  # stepped, not typed
            self._on_numbers()

    def _on_numbers(self) -> None:
        if not self._is_pinned or self._show_problem():
            return
        range = (float(self._low.value()), float(self._high.value()))
        if range != self._colours.range:
            self._pinned[self._colours.metric] = range
            self._change(range=range)

    def _change(self, **keys: Any) -> None:
        colours = dataclasses.replace(self._colours, **keys)
        if colours != self._colours:
            self._apply(colours)
            self.colours_changed.emit(colours)

    def _apply(self, colours: Colours) -> None:
        before, self._colours = self._colours, colours
        self._refresh()
        if colours.range != before.range:  # otherwise keep a number being typed
            self._show_ends()

    def _show_problem(self) -> bool:
        """Show the error in the limits, if any; return True if there is one."""
        text = ""
        if isinstance(self._colours.range, tuple):
            text = self._low.problem or self._high.problem
            if not text and not self._low.value() < self._high.value():
                low, high = (short_number(end) for end in self._colours.range)
                text = tr(
                    "Expected the lower value first. The range {low} to {high} is used until this is corrected.",
                    low=low,
                    high=high,
                )
        show_text(self._problem, text)
        return bool(text)

    def _show_ends(self) -> None:
        ends = self._colours.range if isinstance(self._colours.range, tuple) else _rounded(*self._ends)
        for box, end in zip((self._low, self._high), ends, strict=True):
            if box.value() != end or box.problem:
                box.set_value(end)
        self._show_problem()

    def _refresh(self) -> None:
        colours = self._colours
        self._metric.setCurrentIndex(self._metric.findData(colours.metric))
        set_help(self._metric, tr("Metric"), described(colour_quantity(colours.metric)))
        self._map.show_map(colours.map, change=colours.metric == "q-change")
        self._reverse.setChecked(colours.reverse)
        self._neutral.setChecked(colours.neutral)
        self._range.set_value(_PINNED if isinstance(colours.range, tuple) else colours.range.value)
        for range in (Range.FULL, Range.ACCEPTABLE):
            text, help = _RANGES[range]
            ends, button = declared_range(colours.metric, range), self._range.button(range.value)
            button.setEnabled(ends is not None)
            suffix = _range_text(ends) if ends else tr("unbounded for this metric")
            help = f"{tr(help)}: {suffix}."
            set_help(button, tr("Range: {text}", text=text), help)
        has_values = colours.metric != MATERIAL.name
        for widget in (self._map, self._reverse, self._range):
            widget.setEnabled(has_values)
        for box in (self._low, self._high):
            box.setEnabled(self._is_pinned and has_values)
        self._show_problem()


def _range_text(ends: tuple[float, float]) -> str:
    low, high = (f"{end:g}".replace("inf", "∞").replace("-", "−") for end in ends)
    return tr("{low} to {high}", low=low, high=high)


def _rounded(low: float, high: float) -> tuple[float, float]:
    """Return the ends as labelled on the colour bar, or unrounded if the labels are equal."""
    ends = float(range_label(low, low, high)), float(range_label(high, low, high))
    return ends if ends[0] < ends[1] else (low, high)


class MapBox(ComboBox):
    """Combo box that selects a colour map for values; changes have one fixed map.

    Signals
    -------
    chosen(str)
        The user selected the map with this name.
    """

    chosen = Signal(str)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        let_shrink(self, 6)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setIconSize(_SWATCH)
        self.activated.connect(self._on_activated)

    def show_map(self, name: str, change: bool) -> None:
        """List the maps of values, or the diverging map if `change`, and select a map by name."""
        maps = (CHANGE_MAP,) if change else value_maps()
        if self.findData(maps[0]) < 0:
            self.clear()
            for at, key in enumerate(maps):
                self.add(tr(COLOUR_MAPS[key].title) or key, tr(COLOUR_MAPS[key].help), key)
                self.setItemIcon(at, _swatch(key))
        self.setCurrentIndex(max(self.findData(name), 0))
        set_help(self, tr("Colour map"), tr(COLOUR_MAPS[CHANGE_MAP].help) if change else tr(_VALUE_MAPS_HELP))

    def _on_activated(self) -> None:
        if self.currentData() in value_maps():
            self.chosen.emit(self.currentData())


def _swatch(name: str) -> QIcon:
    """Return an icon of a map, drawn at four times its size so that it is sharp at any scale."""
    colours = np.ascontiguousarray(COLOUR_MAPS[name].table[None])
    image = QImage(colours.tobytes(), colours.shape[1], 1, 3 * colours.shape[1], QImage.Format.Format_RGB888)
    return QIcon(QPixmap.fromImage(image.scaled(_SWATCH * 4)))
