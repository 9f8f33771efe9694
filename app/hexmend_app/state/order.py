"""What the next run is to do: the method with its values and its limits, as the user has set them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from PySide6.QtCore import QObject, Signal

from hexmend.parameters import current_name, from_values
from hexmend.run import StoppingCriteria
from hexmend.run.recipe import Stage
from hexmend.smoothers import DEFAULT_METHOD, METHODS, Smoother


@dataclass(frozen=True)
class OrderData:
    """What a session keeps of the order: the stage, why it was chosen, and what was last set for each method."""

    stage: Stage
    why: str
    values: dict[str, dict[str, Any]]

    def __post_init__(self) -> None:
        for method, values in self.values.items():
            from_values(METHODS[method], values, owner=method)
        today = {
            method: {current_name(METHODS[method], name): value for name, value in values.items()}
            for method, values in self.values.items()
        }
        object.__setattr__(self, "values", today)


class Order(QObject):
    """The method at hand, and what was last set for the others.

    Signals
    -------
    changed
        The method, a value or a limit is another.
    chosen
        Somebody else than the user's hand has set `stage`: forms show it.
    refused
        Somebody wanted the stage while one of its values is wrong.

    Attributes
    ----------
    method : str
        Name of the method at hand.
    stage : Stage or None
        The method with its values and limits; None while one of them is wrong.
    begun : Stage or None
        What the run under way is doing: only what is set otherwise from then on is a change of it.
    why : str
        Why somebody else has chosen the stage; "" once the user has changed it.
    """

    changed = Signal()
    chosen = Signal()
    refused = Signal()

    def __init__(self, parent: QObject | None = None):
        super().__init__(parent)
        self.method = DEFAULT_METHOD
        self.stage: Stage | None = Stage(METHODS[DEFAULT_METHOD](), StoppingCriteria())
        self.begun: Stage | None = None
        self.why = ""
        self._values: dict[str, dict[str, Any]] = {}

    @property
    def smoother(self) -> Smoother | None:
        """The method with its values; None while something is wrong."""
        return self.stage and self.stage.smoother

    def set(self, method: str, values: Mapping[str, Any], stage: Stage | None) -> None:
        """Take what forms show: a method, the values that are admitted, and all of it, or None where one is wrong."""
        self._values[method] = dict(values)
        if (method, stage) != (self.method, self.stage):
            self.method, self.stage, self.why = method, stage, ""
            self.changed.emit()

    def choose(self, stage: Stage, why: str = "") -> None:
        """Set the method, its values and the limits, and say why."""
        self.method, self.stage = stage.smoother.name, stage
        self._values[self.method] = stage.smoother.values()
        self.why = why
        self.chosen.emit()
        self.changed.emit()

    def show_at_work(self, stage: Stage) -> None:
        """Set what the run under way is doing."""
        self.begun = stage
        self.choose(stage)

    def given(self) -> OrderData:
        """What a session keeps; where a value is wrong, what was admitted last, with the usual limits."""
        stage = self.stage or Stage(self.smoother_of(self.method), StoppingCriteria())
        return OrderData(stage, self.why, {method: dict(values) for method, values in self._values.items()})

    def take(self, data: OrderData) -> None:
        """Set what a session has kept."""
        self._values = {method: dict(values) for method, values in data.values.items()}
        self.begun = None
        self.choose(data.stage, data.why)

    def values_of(self, method: str) -> dict[str, Any]:
        """What was last set for a method; empty where nothing was."""
        return dict(self._values.get(method, {}))

    def smoother_of(self, method: str) -> Smoother:
        """A method with what was last set for it."""
        return METHODS[method](**self.values_of(method))

    def use(self, use: Callable[[Stage], object]) -> None:
        """Hand the stage over, unless a value is wrong: then forms say which."""
        if self.stage is None:
            self.refused.emit()
        else:
            use(self.stage)
