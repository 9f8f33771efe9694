"""Recipes in the window: edited, loaded, saved and run."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from hexmend.run.recipe import Recipe
from hexmend.run.recipe_files import read_recipe, write_recipe
from hexmend_app.feature import Action, Feature, Host, Panel, PanelPlace
from hexmend_app.features.recipe.recipe_panel import RecipePanel
from hexmend_app.resources import recipes
from hexmend_app.state.run.run_controller import Phase
from hexmend_app.translation import tr
from hexmend_app.widgets.dialogs.questions import ask_to_open, ask_to_save


class FeatureRecipe(Feature):
    """Edits, loads, saves and runs a recipe, and marks the active stage."""

    def __init__(self, host: Host):
        super().__init__(host)
        self._draft, self._smoothing = self.session.recipe_draft, self.session.run
        panel = self.panel = RecipePanel(self._draft, self.session.run_setup)
        panel.run_button.clicked.connect(self.run)
        panel.load_requested.connect(self.ask_load)
        panel.save_button.clicked.connect(self.ask_save)
        panel.shipped_requested.connect(self.load)
        panel.set_shipped([(tr(read_recipe(path).title), path) for path in recipes()])

    def actions(self) -> Iterable[Action]:
        """Yield the actions that run, load and save the recipe."""
        yield Action(
            id="recipe_run",
            text=tr("R&un recipe"),
            menu="Smooth",
            section=2,
            keys="Ctrl+Shift+F5",
            help=tr("Run the stages of the recipe in sequence, as one run."),
            handle=self.run,
            enabled=lambda: bool(self._draft.stages) and self.session.editable,
        )
        yield Action(
            id="recipe_load",
            text=tr("&Load recipe…"),
            menu="Smooth",
            section=2,
            help=tr("Load a recipe: methods that run in sequence."),
            handle=self.ask_load,
            enabled=lambda: self.session.editable,
        )
        yield Action(
            id="recipe_save",
            text=tr("Sa&ve recipe…"),
            menu="Smooth",
            section=2,
            help=tr("Save the recipe as a TOML file."),
            handle=self.ask_save,
            enabled=lambda: bool(self._draft.stages),
        )

    def panels(self) -> Iterable[Panel]:
        """Yield the panel with the stages."""
        yield Panel(
            id="recipe",
            title=tr("Recipe"),
            widget=self.panel,
            place=PanelPlace.TOOLS,
            tab=tr("Smooth"),
            order=11,
            help=tr("Methods that run in sequence, as one run."),
        )

    def refresh(self) -> None:
        """Show the stages and mark the active one."""
        smoothing = self._smoothing
        self.panel.show_draft()
        self.panel.set_editable(self.session.editable)
        running = smoothing.busy and isinstance(smoothing.work, Recipe)
        number = smoothing.record.rows[-1].get("stage") if running and smoothing.record.rows else None
        if self._seen.changed("active stage", number):
            self.panel.set_active(number)
        # The iteration tells apart two pauses without a refresh between them.
        paused_at = (smoothing.record, smoothing.record.newest) if number and smoothing.phase is Phase.PAUSED else None
        if self._seen.changed("paused at", paused_at) and paused_at is not None:
            self.session.run_setup.show_active(smoothing.work.stages[number - 1])  # type: ignore[union-attr]

    def run(self) -> None:
        """Run the recipe on the displayed mesh."""
        recipe = self._draft.recipe
        if recipe is not None and self.session.editable and self.memory_suffices(recipe):
            self.session.commands.run_recipe(recipe)

    def ask_load(self) -> None:
        """Ask for a file and load its recipe."""
        if path := ask_to_open(self.host.dialog_parent, tr("Load recipe"), tr("Recipes (*.toml);;All files (*)")):
            self.load(path)

    def load(self, path: str | Path) -> None:
        """Load the recipe of a file; if that fails, show the error and keep the present recipe."""
        if self.try_and_report(tr("Recipe not loaded"), lambda: self._draft.load(read_recipe(path))):
            self.panel.select(0)

    def ask_save(self) -> None:
        """Ask for a file and save the recipe."""
        if path := ask_to_save(self.host.dialog_parent, tr("Save recipe as"), "recipe.toml", tr("Recipe (*.toml)")):
            self.save(path)

    def save(self, path: str | Path) -> None:
        """Save the recipe, or show the error."""
        self.write_file(tr("Recipe"), path, lambda at: write_recipe(at, self._draft.recipe))
