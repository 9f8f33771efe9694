"""Set-up of the next run: the method with its values and limits, as the user has set them."""

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
class RunSetupData:
    """Data of the set-up in a session file: stage, reason of its choice, and the last values of each method."""

    stage: Stage
    reason: str
    values: dict[str, dict[str, Any]]

    def __post_init__(self) -> None:
        for method, values in self.values.items():
            from_values(METHODS[method], values, owner=method)
        today = {
            method: {current_name(METHODS[method], name): value for name, value in values.items()}
            for method, values in self.values.items()
        }
        object.__setattr__(self, "values", today)


class RunSetup(QObject):
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
    reason : str
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
        self.reason = ""
        self._values: dict[str, dict[str, Any]] = {}

    @property
    def smoother(self) -> Smoother | None:
        """The method with its values; None while something is wrong."""
        return self.stage and self.stage.smoother

    def set(self, method: str, values: Mapping[str, Any], stage: Stage | None) -> None:
        """Take what forms show: a method, the values that are admitted, and all of it, or None where one is wrong."""
        self._values[method] = dict(values)
        if (method, stage) != (self.method, self.stage):
            self.method, self.stage, self.reason = method, stage, ""
            self.changed.emit()

    def choose(self, stage: Stage, reason: str = "") -> None:
        """Set the method, its values and the limits, with the reason."""
        self.method, self.stage = stage.smoother.name, stage
        self._values[self.method] = stage.smoother.values()
        self.reason = reason
        self.chosen.emit()
        self.changed.emit()

    def show_at_work(self, stage: Stage) -> None:
        """Set what the run under way is doing."""
        self.begun = stage
        self.choose(stage)

    def to_data(self) -> RunSetupData:
        """Return the data for a session file; if a value is invalid, the last valid stage with default limits."""
        stage = self.stage or Stage(self.smoother_of(self.method), StoppingCriteria())
        return RunSetupData(stage, self.reason, {method: dict(values) for method, values in self._values.items()})

    def restore(self, data: RunSetupData) -> None:
        """Set what a session has kept."""
        self._values = {method: dict(values) for method, values in data.values.items()}
        self.begun = None
        self.choose(data.stage, data.reason)

    def values_of(self, method: str) -> dict[str, Any]:
        """Values that were last set for a method; empty if there are none."""
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
