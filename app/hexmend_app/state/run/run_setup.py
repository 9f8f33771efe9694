"""Set-up of the next run: the method, its values and limits, rules of motion, and the recipe that the user edits."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from PySide6.QtCore import QObject, Signal

from hexmend.mesh.mesh import Mesh
from hexmend.mesh.rules import MotionRules
from hexmend.mesh.rules.named_sets import set_names
from hexmend.parameters import Parametrised, declared, from_values
from hexmend.run import StoppingCriteria
from hexmend.run.recipe import Recipe, Stage
from hexmend.smoothers import DEFAULT_METHOD, METHODS, Smoother


@dataclass(frozen=True)
class RunSetupData:
    """Data of the set-up in a session file: stage, reason of its choice, last values of each method, and rules."""

    stage: Stage
    reason: str
    values: dict[str, dict[str, Any]]
    rules: MotionRules

    def __post_init__(self) -> None:
        for method, values in self.values.items():
            from_values(METHODS[method], values, owner=method)


class RunSetup(QObject):
    """The selected method, the last values of all methods, and the rules of motion.

    Signals
    -------
    changed
        The method, a value, a limit or a rule has changed.
    chosen
        The program, not the user, has set `stage`.
    refused
        The stage was requested while one of its values is invalid.

    Attributes
    ----------
    method : str
        Name of the selected method.
    stage : Stage or None
        The method with its values and limits; None while one of them is invalid.
    active_stage : Stage or None
        The stage that the active run executes; only a different stage changes that run.
    reason : str
        Why the program has chosen the stage; "" after the user has changed it.
    rules : MotionRules
        Rules for interfaces and named sets in the next run, of a method or of a recipe.
    """

    changed = Signal()
    chosen = Signal()
    refused = Signal()

    def __init__(self, parent: QObject | None = None):
        super().__init__(parent)
        self.method = DEFAULT_METHOD
        self.stage: Stage | None = Stage(METHODS[DEFAULT_METHOD](), StoppingCriteria())
        self.active_stage: Stage | None = None
        self.reason = ""
        self.rules = MotionRules()
        self._values: dict[str, dict[str, Any]] = {}

    @property
    def smoother(self) -> Smoother | None:
        """The method with its values; None while one of them is invalid."""
        return None if self.stage is None else self.stage.smoother

    def set(self, method: str, values: Mapping[str, Any], stage: Stage | None) -> None:
        """Set the input of forms: a method, its valid values, and the stage, None if a value is invalid."""
        self._values[method] = dict(values)
        if (method, stage) != (self.method, self.stage):
            self.method, self.stage, self.reason = method, stage, ""
            self.changed.emit()

    def set_rules(self, rules: MotionRules) -> None:
        """Set the rules of motion."""
        if rules != self.rules:
            self.rules = rules
            self.changed.emit()

    def follow_renamed_sets(self, before: Mapping[str, object], mesh: Mesh) -> None:
        """Give the rules of hex sets that a mesh has under another name that name.

        Parameters
        ----------
        before : mapping
            Earlier hex sets by name; those that are unchanged are the same arrays.
        mesh : Mesh
        """
        present, rules = set_names(mesh), self.rules
        for name in [name for name in rules.names if name in before and name not in present]:
            renamed = (new for new, hexes in mesh.hex_sets.items() if hexes is before[name] and new not in before)
            rules = rules.with_renamed(name, next(renamed, name))
        self.set_rules(rules)

    def choose(self, stage: Stage, reason: str = "") -> None:
        """Choose the stage for the user, for a reason; forms show it."""
        self.method, self.stage = stage.smoother.name, stage
        self._values[self.method] = stage.smoother.values()
        self.reason = reason
        self.chosen.emit()
        self.changed.emit()

    def reset(self) -> None:
        """Set the values of all methods, the limits and the rules of motion to their defaults; the method stays."""
        self._values.clear()
        self.rules = MotionRules()
        self.choose(Stage(METHODS[self.method](), StoppingCriteria()))

    def show_active(self, stage: Stage) -> None:
        """Choose the stage that the active run executes."""
        self.active_stage = stage
        self.choose(stage)

    def to_data(self) -> RunSetupData:
        """Return the data for a session file; if a value is invalid, the last valid stage with default limits."""
        stage = self.stage or Stage(self.smoother_of(self.method), StoppingCriteria())
        values = {method: dict(values) for method, values in self._values.items()}
        return RunSetupData(stage, self.reason, values, self.rules)

    def restore(self, data: RunSetupData) -> None:
        """Restore the set-up of a session file."""
        self._values = {method: dict(values) for method, values in data.values.items()}
        self.active_stage = None
        self.rules = data.rules
        self.choose(data.stage, data.reason)

    def values_of(self, method: str) -> dict[str, Any]:
        """Return the values that were last set for a method; empty if there are none."""
        return dict(self._values.get(method, {}))

    def smoother_of(self, method: str) -> Smoother:
        """Return a method with the values that were last set for it."""
        return METHODS[method](**self.values_of(method))

    def checked_stage(self) -> Stage | None:
        """Return the stage; if a value is invalid, emit `refused`, for forms to show which, and return None."""
        if self.stage is None:
            self.refused.emit()
        return self.stage


def settings_text(work: Smoother | Recipe, stop: StoppingCriteria | None = None) -> str:
    """Return the values of a run that differ from the defaults; "" if none does.

    Parameters
    ----------
    work : Smoother or Recipe
    stop : StoppingCriteria, optional
        None for a recipe, whose stages have their own.

    Examples
    --------
    >>> from hexmend.smoothers import METHODS
    >>> settings_text(METHODS["mend"](p=1, boundary="slide"), StoppingCriteria(max_iterations=20))
    'boundary=slide, p=1, max_iterations=20'
    >>> settings_text(Recipe.of("getme", METHODS["local-sd"](p=4)))
    'getme; local-sd p=4'
    """
    if not isinstance(work, Recipe):
        return ", ".join([*_changed(work), *_changed(stop or StoppingCriteria())])
    return "; ".join(f"{one.smoother.name} {settings_text(one.smoother, one.stop)}".strip() for one in work.stages)


def rules_text(rules: MotionRules) -> str:
    """Return rules of motion as text; "" without rules.

    >>> rules_text(MotionRules("slide", fix=("inlet", "outlet"), periodic=(("left", "right"),)))
    'interfaces=slide, fix=inlet outlet, periodic=left:right'
    """
    texts = []
    for key, value in rules.values().items():
        names = [value] if isinstance(value, str) else [one if isinstance(one, str) else ":".join(one) for one in value]
        texts.append(f"{key}={' '.join(names)}")
    return ", ".join(texts)


def _changed(values: Parametrised) -> Iterator[str]:
    for one in declared(values):
        value = getattr(values, one.name)
        if value != one.default:
            yield f"{one.name}={value:g}" if isinstance(value, float) else f"{one.name}={value}"


@dataclass(frozen=True)
class RecipeDraftData:
    """Data of the recipe in a session file."""

    title: str
    stages: tuple[Stage, ...]


class RecipeDraft(QObject):
    """Stages in order, with a title; unlike a `Recipe` it may be empty.

    Parameters
    ----------
    setup : RunSetup
        Has the rules of motion of the recipe, which are those of all runs.

    Attributes
    ----------
    title : str
        "" to use the titles of the methods.
    stages : tuple of Stage

    Signals
    -------
    changed
    """

    changed = Signal()

    def __init__(self, setup: RunSetup, parent: QObject | None = None):
        super().__init__(parent)
        self._setup = setup
        self.title = ""
        self.stages: tuple[Stage, ...] = ()

    @property
    def recipe(self) -> Recipe | None:
        """Recipe to run or save; None if there is no stage."""
        return Recipe.of(*self.stages, title=self.title, rules=self._setup.rules) if self.stages else None

    def to_data(self) -> RecipeDraftData:
        """Return the data for a session file."""
        return RecipeDraftData(self.title, self.stages)

    def restore(self, data: RecipeDraftData) -> None:
        """Restore the recipe of a session file."""
        self._set(data.stages, data.title)

    def load(self, recipe: Recipe) -> None:
        """Take the stages and the title from a recipe, and the rules of motion if it has any."""
        if recipe.rules:
            self._setup.set_rules(recipe.rules)
        default = Recipe.of(*recipe.stages).title
        self._set(recipe.stages, "" if recipe.title == default else recipe.title)

    def rename(self, title: str) -> None:
        """Set the title."""
        self._set(self.stages, title.strip())

    def add(self, stage: Stage) -> None:
        """Add a stage at the end."""
        self._set((*self.stages, stage))

    def replace(self, at: int, stage: Stage) -> None:
        """Replace a stage."""
        self._set((*self.stages[:at], stage, *self.stages[at + 1 :]))

    def remove(self, at: int) -> None:
        """Remove a stage."""
        self._set((*self.stages[:at], *self.stages[at + 1 :]))

    def move(self, at: int, to: int) -> None:
        """Move a stage to another position."""
        others = [*self.stages[:at], *self.stages[at + 1 :]]
        self._set((*others[:to], self.stages[at], *others[to:]))

    def _set(self, stages: tuple[Stage, ...], title: str | None = None) -> None:
        self.stages = stages
        self.title = self.title if title is None else title
        self.changed.emit()
