"""Recipes in the window: the lines between the stages, the panel that lists them, files, and the run."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from hexmend.errors import HexmendError
from hexmend.parameters import Parametrised, declared
from hexmend.run.recipe import Recipe, Stage
from hexmend.run.recipe_files import read_recipe, write_recipe
from hexmend_app.feature import Action, ChangeTracker, Feature, Host, Panel, PanelPlace
from hexmend_app.features.recipe.recipe_panel import RecipePanel
from hexmend_app.resources import recipes
from hexmend_app.state.run.run_controller import Phase
from hexmend_app.state.session.user_events import FileExported
from hexmend_app.widgets.dialogs.questions import ask_recipe, ask_recipe_target
from hexmend_app.widgets.wording import name_in_words, short_number

_LIMITS = {
    "max_iterations": "at most {} iterations",
    "tolerance": "tolerance {}",
    "max_seconds": "at most {} s",
    "keep_last": "the last iterate kept",
}


class FeatureRecipe(Feature):
    """Puts a recipe together, loads and saves it, runs it, and marks which of its stages is at work."""

    order = 27

    def __init__(self, host: Host):
        super().__init__(host)
        chain, order = self.session.recipe_draft, self.session.run_setup
        self._chain, self._smoothing = chain, self.session.run
        self._seen = ChangeTracker()
        panel = self.panel = RecipePanel()
        panel.add_requested.connect(lambda: order.use(self._add))
        panel.replace_requested.connect(lambda at: order.use(lambda stage: chain.replace(at, stage)))
        panel.shown_requested.connect(self._show_above)
        panel.move_requested.connect(self._move)
        panel.remove_requested.connect(chain.remove)
        panel.renamed.connect(chain.rename)
        panel.run_requested.connect(self.run)
        panel.load_requested.connect(self.ask_load)
        panel.save_requested.connect(self.ask_save)
        panel.shipped_requested.connect(self.load)
        panel.set_shipped([(read_recipe(path).title, path) for path in recipes()])

    def actions(self) -> Sequence[Action]:
        """Run, load, save."""
        some = self._some
        return (
            Action(
                id="recipe_run",
                text="R&un the recipe",
                menu="Smooth",
                part=2,
                keys="Ctrl+Shift+F5",
                help="Run the stages of the recipe one after another, as one run.",
                handle=self.run,
                enabled=lambda: some() and self.session.editable,
            ),
            Action(
                id="recipe_load",
                text="&Load a recipe…",
                menu="Smooth",
                part=2,
                help="Load methods to be run one after another.",
                handle=self.ask_load,
                enabled=lambda: self.session.editable,
            ),
            Action(
                id="recipe_save",
                text="Sa&ve the recipe…",
                menu="Smooth",
                part=2,
                help="Save the stages as TOML.",
                handle=self.ask_save,
                enabled=some,
            ),
        )

    def panels(self) -> Sequence[Panel]:
        """The stages."""
        return (
            Panel(
                id="recipe",
                title="Recipe",
                widget=self.panel,
                place=PanelPlace.TOOLS,
                tab="Run",
                order=11,
                help="Methods that are run one after another, as one run.",
            ),
        )

    def refresh(self) -> None:
        """Show the stages, and which of them is at work."""
        chain, smoothing = self._chain, self._smoothing
        if self._seen.changed("stages", chain.stages, chain.title):
            usual = Recipe.of(*chain.stages).title if chain.stages else ""
            self.panel.set_stages([_text(stage) for stage in chain.stages], chain.title, usual)
        self.panel.set_editable(self.session.editable)
        going = smoothing.busy and isinstance(smoothing.work, Recipe)
        at = smoothing.record.rows[-1].get("stage") if going and smoothing.record.rows else None
        if self._seen.changed("at work", at):
            self.panel.set_at_work(at)
        # It may have gone on and paused again since it was last shown.
        paused_at = (smoothing.record, smoothing.record.newest) if at and smoothing.phase is Phase.PAUSED else None
        if self._seen.changed("held", paused_at) and paused_at is not None:
            self.session.run_setup.show_at_work(smoothing.work.stages[at - 1])

    def refresh_iteration(self) -> None:
        """Show the newest iteration of a run."""
        self.refresh()

    def _some(self) -> bool:
        return bool(self._chain.stages)

    def run(self) -> None:
        """Run the recipe on the mesh as it is shown."""
        recipe = self._chain.recipe
        if recipe is not None and self.session.editable:
            self.session.commands.run_recipe(recipe)

    def ask_load(self) -> None:
        """Ask which file, and go on with the recipe in it."""
        path = ask_recipe(self.host.dialog_parent)
        if path:
            self.load(path)

    def load(self, path: str | Path) -> None:
        """Go on with the recipe of a file; where it is none, say why, and keep what there was."""
        try:
            recipe = read_recipe(path)
        except HexmendError as error:
            self.host.messages.show_error("The recipe was not loaded", str(error))
            return
        self._chain.take(recipe)
        self._choose(0)

    def ask_save(self) -> None:
        """Ask where the recipe goes and write it."""
        path = ask_recipe_target(self.host.dialog_parent)
        if path:
            self.save(path)

    def save(self, path: str | Path) -> None:
        """Write the recipe."""
        try:
            self.session.commands.export(FileExported("recipe", write_recipe, (Path(path), self._chain.recipe)))
        except HexmendError as error:
            self.host.messages.show_error("The recipe was not saved", str(error))
        else:
            self.host.messages.show_info(f"Recipe saved to {path}")

    def _add(self, stage: Stage) -> None:
        self._chain.add(stage)
        self._choose(len(self._chain.stages) - 1)

    def _move(self, at: int, to: int) -> None:
        self._chain.move(at, to)
        self._choose(to)

    def _choose(self, at: int) -> None:
        self.refresh()  # what is chosen has to be listed
        self.panel.choose(at)

    def _show_above(self, at: int) -> None:
        if self.session.editable:
            self.session.run_setup.choose(self._chain.stages[at])


def _text(stage: Stage) -> tuple[str, str]:
    """A stage in words, and what it does."""
    own = [*_own(stage.smoother), *_own(stage.stop, _LIMITS)]
    words = f"{stage.smoother.title} ({', '.join(own)})" if own else stage.smoother.title
    return words, f"{words}: {stage.smoother.help}"


def _own(part: Parametrised, words: Mapping[str, str] | None = None) -> list[str]:
    """The values that are not the defaults, in words."""
    return [
        (words or {}).get(one.name, f"{name_in_words(one.name)} {{}}").format(_value(value))
        for one in declared(part)
        if (value := getattr(part, one.name)) != one.default
    ]


def _value(value: object) -> str:
    if isinstance(value, bool):
        return "on" if value else "off"
    return short_number(value) if isinstance(value, float) else str(value)
