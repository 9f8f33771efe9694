"""Recipes in the window: the lines between the stages, the panel that lists them, files, and the run."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from PySide6.QtWidgets import QWidget

from hexmend.errors import HexmendError
from hexmend.io import read_recipe, write_recipe
from hexmend.parameters import Parametrised, declared
from hexmend.recipe import Recipe, Stage
from hexmend.run import Stop
from hexmend.smoothers import METHODS
from hexmend_app.features.smooth.smoothing_panel import SmoothingPanel
from hexmend_app.resources import recipes
from hexmend_app.state.chain import Chain
from hexmend_app.state.commands import Commands
from hexmend_app.state.run import Frame, Phase
from hexmend_app.state.session import Session
from hexmend_app.widgets.message_bar import MessageBar
from hexmend_app.widgets.questions import ask_recipe, ask_recipe_target, remember_folder
from hexmend_app.widgets.wording import name_in_words, short_number

_LIMITS = {"max_iterations": "at most {} iterations", "tolerance": "tolerance {}", "max_seconds": "at most {} s"}


class Chaining:
    """Puts a recipe together, loads and saves it, runs it, and says which of its stages is at work.

    Parameters
    ----------
    parent : QWidget
        The dialogs stand before it.
    session : Session
        The window's state.
    commands : Commands
    panel : SmoothingPanel
        Holds the method that becomes a stage, and the list of the stages.
    messages : MessageBar
    """

    def __init__(
        self, parent: QWidget, session: Session, commands: Commands, panel: SmoothingPanel, messages: MessageBar
    ):
        self._parent, self._session, self._commands = parent, session, commands
        self._panel, self._list, self._messages = panel, panel.recipe_panel, messages
        self._running: list[Stage] = []  # as they are run: the one at work may be changed while the run is paused
        self._at = 1  # number of the stage at work
        chain = self.chain = Chain(parent)
        chain.changed.connect(self._show)
        self._list.add_requested.connect(lambda: panel.request(lambda *order: self._add(_stage(*order))))
        self._list.replace_requested.connect(
            lambda at: panel.request(lambda *order: self.chain.replace(at, _stage(*order)))
        )
        self._list.shown_requested.connect(self._show_above)
        self._list.move_requested.connect(self._move)
        self._list.remove_requested.connect(chain.remove)
        self._list.renamed.connect(chain.rename)
        self._list.run_requested.connect(self.run)
        self._list.load_requested.connect(self.ask_load)
        self._list.save_requested.connect(self.ask_save)
        self._list.shipped_requested.connect(self.load)
        self._list.set_shipped([(read_recipe(path).title, path) for path in recipes()])
        session.smoothing.iterated.connect(self._on_iterated)
        session.smoothing.phase_changed.connect(self._on_phase)
        panel.change_requested.connect(self._on_changed)
        session.document.mesh_replaced.connect(self._enable)
        for told in (session.opener.began, session.opener.ended, session.opener.cancelled, session.opener.failed):
            told.connect(self._enable)
        self._show()

    def handlers(self) -> dict[str, Callable]:
        """What its actions do, by id."""
        return {"recipe_run": self.run, "recipe_load": self.ask_load, "recipe_save": self.ask_save}

    def offered(self) -> dict[str, bool]:
        """Which of its actions can be done now."""
        some, editable = bool(self.chain.stages), self._session.editable
        return {"recipe_run": some and editable, "recipe_load": editable, "recipe_save": some}

    def run(self) -> None:
        """Run the recipe on the mesh as it is shown."""
        recipe = self.chain.recipe
        if recipe is not None and self._session.editable:
            self._running, self._at = list(recipe.stages), 1
            self._commands.run_recipe(recipe)

    def ask_load(self) -> None:
        """Ask which file, and go on with the recipe in it."""
        path = ask_recipe(self._parent)
        if path:
            remember_folder(Path(path))
            self.load(path)

    def load(self, path: str | Path) -> None:
        """Go on with the recipe of a file; where it is none, say why, and keep what there was."""
        try:
            recipe = read_recipe(path)
        except HexmendError as error:
            self._messages.show_error("The recipe was not loaded", str(error))
            return
        self.chain.take(recipe)
        self._list.choose(0)

    def ask_save(self) -> None:
        """Ask where the recipe goes and write it."""
        path = ask_recipe_target(self._parent)
        if path:
            self.save(path)

    def save(self, path: str | Path) -> None:
        """Write the recipe."""
        try:
            write_recipe(path, self.chain.recipe)
        except HexmendError as error:
            self._messages.show_error("The recipe was not saved", str(error))
        else:
            self._messages.show_info(f"Recipe saved to {path}")

    def at_work(self, frame: Frame) -> str:
        """Which stage an iteration is of, as a sentence; "" where one method runs alone."""
        if not self._running or not self._session.smoothing.busy:
            return ""
        notes = frame.iteration.notes
        title = METHODS[notes["method"]].title
        return f"Stage {notes['stage']} of {len(self._running)}: {title}."

    def _add(self, stage: Stage) -> None:
        self.chain.add(stage)
        self._list.choose(len(self.chain.stages) - 1)

    def _move(self, at: int, to: int) -> None:
        self.chain.move(at, to)
        self._list.choose(to)

    def _show_above(self, at: int) -> None:
        if self._session.editable:
            self._panel.choose(*_order(self.chain.stages[at]))

    def _show(self) -> None:
        chain = self.chain
        usual = Recipe.of(*chain.stages).title if chain.stages else ""
        self._list.set_stages([_said(stage) for stage in chain.stages], chain.title, usual)
        self._enable()

    def _enable(self) -> None:
        if not self._session.smoothing.busy:
            self._running = []
            self._list.set_at_work(None)
        self._list.set_editable(self._session.editable)

    def _on_iterated(self, frame: Frame) -> None:
        if self.at_work(frame):
            self._at = frame.iteration.notes["stage"]
            self._list.set_at_work(self._at)

    def _on_phase(self) -> None:
        self._enable()
        if self._running and self._session.smoothing.phase is Phase.PAUSED:
            self._panel.show_at_work(*_order(self._running[self._at - 1]))

    def _on_changed(self, *order: Any) -> None:
        if self._running:
            self._running[self._at - 1] = _stage(*order)


def _stage(name: str, values: dict, stop: dict) -> Stage:
    return Stage(METHODS[name](**values), Stop(**stop))


def _order(stage: Stage) -> tuple[str, dict, dict]:
    return stage.smoother.name, stage.smoother.values(), stage.stop.values()


def _said(stage: Stage) -> tuple[str, str]:
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
