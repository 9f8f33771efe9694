"""Panel for a recipe, whose stages are taken from the smoothing panel."""

from __future__ import annotations

from collections.abc import Iterable
from html import escape
from pathlib import Path

from PySide6.QtCore import QSignalBlocker, QSize, Qt, Signal
from PySide6.QtWidgets import (
    QGridLayout,
    QHBoxLayout,
    QLineEdit,
    QListWidget,
    QListWidgetItem,
    QMenu,
    QVBoxLayout,
    QWidget,
)

from hexmend.run.recipe import Recipe, Stage
from hexmend_app.feature import ChangeTracker
from hexmend_app.state.run.run_setup import RecipeDraft, RunSetup, settings_text
from hexmend_app.theme.spacing import apply_spacing, fill
from hexmend_app.theme.style import bold, icon_button, labelled, push_button, set_help, small_label
from hexmend_app.translation import tr

_EMPTY = (
    "No stages. Select a method above and add it, or load a recipe. Each stage starts from the best result of the "
    "stage before it."
)
#: Maximum number of stages visible without scrolling.
_VISIBLE = 4


class RecipePanel(QWidget):
    """List of the stages with buttons to edit them.

    Parameters
    ----------
    draft : RecipeDraft
    setup : RunSetup
        Its stage is added, and a stage that is edited becomes its stage.

    Signals
    -------
    load_requested
    shipped_requested(Path)
        Load a recipe that comes with Hexmend.
    """

    load_requested = Signal()
    shipped_requested = Signal(object)

    def __init__(self, draft: RecipeDraft, setup: RunSetup, parent: QWidget | None = None):
        super().__init__(parent)
        self._draft, self._setup = draft, setup
        self._seen = ChangeTracker()
        self._editable = True
        self._title = QLineEdit()
        set_help(self._title, tr("Title of the recipe"), tr("Name of the recipe in tables; saved with it."))
        self._title.editingFinished.connect(self._rename)
        self._list = QListWidget()
        self._list.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        set_help(
            self._list, tr("Stages"), tr("Stages in running order. Press Enter or double-click to edit a stage above.")
        )
        self._list.itemActivated.connect(self._edit)
        self._list.currentRowChanged.connect(self._enable)
        self._empty = small_label(tr(_EMPTY))
        self._add = push_button(
            tr("Add"), tr("Add the method above, with its parameters and limits, as the last stage."), "plus"
        )
        self._replace = icon_button(
            "swap-horizontal", tr("Replace the stage"), tr("Replace the selected stage by the method above.")
        )
        self._up = icon_button("chevron-up", tr("Move up"), tr("Move the selected stage up."))
        self._down = icon_button("chevron-down", tr("Move down"), tr("Move the selected stage down."))
        self._remove = icon_button("delete-outline", tr("Remove the stage"), tr("Remove the selected stage."))
        self.run_button = push_button(
            tr("Run"), tr("Run the stages in sequence, as one run."), "play", name=tr("Run recipe")
        )
        self._load = push_button(
            tr("Load"), tr("Load a recipe from a file or a built-in recipe."), "folder-open-outline"
        )
        self.save_button = icon_button(
            "content-save-outline", tr("Save"), tr("Save the recipe as a TOML file, for hexmend smooth.")
        )
        self._menu = QMenu(self._load)
        self._menu.setToolTipsVisible(True)
        self._load.setMenu(self._menu)
        self._add.clicked.connect(self._add_stage)
        self._replace.clicked.connect(self._replace_stage)
        self._up.clicked.connect(lambda: self._move(-1))
        self._down.clicked.connect(lambda: self._move(1))
        self._remove.clicked.connect(lambda: draft.remove(self._list.currentRow()))
        self._lay_out()

    def _lay_out(self) -> None:
        head = fill(QHBoxLayout(), labelled(tr("Title"), self._title), (self._title, 1), spacing=4)
        edit = fill(QHBoxLayout(), (self._add, 1), self._replace, self._up, self._down, self._remove, spacing=4)
        foot = apply_spacing(QGridLayout())
        for column, button in enumerate((self.run_button, self._load)):
            button.setMinimumWidth(button.minimumSizeHint().width())
            foot.addWidget(button, 0, column)
            foot.setColumnStretch(column, 1)
        foot.addWidget(self.save_button, 0, 2)
        fill(QVBoxLayout(self), head, self._empty, self._list, edit, foot, margins=(0, 0, 0, 0), spacing=4)

    def set_shipped(self, recipes: Iterable[tuple[str, Path]]) -> None:
        """List the titles and files of the built-in recipes in the menu."""
        self._menu.clear()
        self._menu.addAction(tr("From a &file…")).triggered.connect(lambda: self.load_requested.emit())
        self._menu.addSeparator()
        for title, path in recipes:
            action = self._menu.addAction(title.replace("&", "&&"))
            action.setToolTip(tr("Built-in recipe {name}.", name=path.name))
            action.triggered.connect(lambda _=False, path=path: self.shipped_requested.emit(path))

    def show_draft(self) -> None:
        """Show the stages and the title of the draft, if they have changed."""
        stages, title = self._draft.stages, self._draft.title
        if not self._seen.changed("stages", stages, title):
            return
        row = self._list.currentRow()
        with QSignalBlocker(self._list):
            self._list.clear()
            for number, stage in enumerate(stages, start=1):
                text = stage_title(stage)
                item = QListWidgetItem(f"{number}  {text}")
                item.setToolTip(f"<qt>{escape(text)}: {escape(tr(stage.smoother.help))}</qt>")
                item.setSizeHint(QSize(1, self._list.fontMetrics().height() + 4))  # texts are elided, not scrolled
                self._list.addItem(item)
            self._list.setCurrentRow(min(row, len(stages) - 1))
        height = self._list.sizeHintForRow(0) if stages else 0
        self._list.setFixedHeight(height * min(len(stages), _VISIBLE) + 2 * self._list.frameWidth() + 2)
        self._list.setVisible(bool(stages))
        self._empty.setVisible(not stages)
        self._title.setText(title)
        self._title.setPlaceholderText(Recipe.of(*stages).title if stages else "")
        self._title.setCursorPosition(0)
        self._enable()

    def select(self, at: int) -> None:
        """Select a stage without sending a signal; it is listed first."""
        self.show_draft()
        with QSignalBlocker(self._list):
            self._list.setCurrentRow(at)
        self._enable()

    def set_active(self, number: int | None) -> None:
        """Mark the active stage, counted from 1, or none."""
        for at in range(self._list.count()):
            item = self._list.item(at)
            item.setFont(bold(item.font(), at + 1 == number))

    def set_editable(self, editable: bool) -> None:
        """Enable or disable editing and running the stages."""
        self._editable = editable
        self._enable()

    def _add_stage(self) -> None:
        if (stage := self._setup.checked_stage()) is not None:
            self._draft.add(stage)
            self.select(len(self._draft.stages) - 1)

    def _replace_stage(self) -> None:
        if (stage := self._setup.checked_stage()) is not None:
            self._draft.replace(self._list.currentRow(), stage)

    def _edit(self, item: QListWidgetItem) -> None:
        if self._editable:
            self._setup.choose(self._draft.stages[self._list.row(item)])

    def _move(self, by: int) -> None:
        at = self._list.currentRow()
        self._draft.move(at, at + by)
        self.select(at + by)

    def _rename(self) -> None:
        if self._title.text().strip() != self._draft.title:
            self._draft.rename(self._title.text())

    def _enable(self) -> None:
        count, at = self._list.count(), self._list.currentRow()
        for widget in (self._title, self._add, self._load):
            widget.setEnabled(self._editable)
        for button in (self._replace, self._remove):
            button.setEnabled(self._editable and at >= 0)
        self._up.setEnabled(self._editable and at > 0)
        self._down.setEnabled(self._editable and 0 <= at < count - 1)
        self.run_button.setEnabled(self._editable and count > 0)
        self.save_button.setEnabled(count > 0)


def stage_title(stage: Stage) -> str:
    """Return the title of a stage with its changed values.

    >>> from hexmend import METHODS, StoppingCriteria
    >>> stage_title(Stage(METHODS["local-sd"](p=4), StoppingCriteria(max_iterations=3)))
    'Local steepest descent (p=4, max_iterations=3)'
    """
    method, values = tr(stage.smoother.title), settings_text(stage.smoother, stage.stop)
    return f"{method} ({values})" if values else method
