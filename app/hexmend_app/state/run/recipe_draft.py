"""The recipe that the user edits: methods to be run one after another."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtCore import QObject, Signal

from hexmend.run.recipe import Recipe, Stage
from hexmend_app.state.run.run_setup import RunSetup


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
