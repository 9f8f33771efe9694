"""The recipe: methods that are run one after another, put together from what the smoothing panel shows."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape
from pathlib import Path

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtWidgets import (
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QListWidget,
    QListWidgetItem,
    QMenu,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from hexmend_app.theme.style import icon, note, set_help

_EMPTY = (
    "No stage yet. Choose a method above and add it: each stage begins where the one before it was best. "
    "Or load a recipe."
)
#: Stages that are seen without scrolling.
_SEEN = 4


class RecipePanel(QWidget):
    """Lists the stages and asks for their changes.

    Signals
    -------
    add_requested, replace_requested(int)
        The user wants the method shown above as another stage, or in place of one.
    shown_requested(int)
        The user wants a stage's method and values above.
    move_requested(int, int), remove_requested(int)
    renamed(str)
    run_requested, save_requested, load_requested
    shipped_requested(Path)
        The user wants one of the recipes that come with Hexmend.
    """

    add_requested = Signal()
    replace_requested = Signal(int)
    shown_requested = Signal(int)
    move_requested = Signal(int, int)
    remove_requested = Signal(int)
    renamed = Signal(str)
    run_requested = Signal()
    save_requested = Signal()
    load_requested = Signal()
    shipped_requested = Signal(object)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._editable = True
        self._title = QLineEdit()
        set_help(self._title, "Title of the recipe", "What the recipe is called in tables; saved with it.")
        self._title.editingFinished.connect(self._on_title)
        self._shown_title = ""
        self._list = QListWidget()
        self._list.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        set_help(self._list, "Stages", "In the order in which they are run; Enter or a double-click shows one above.")
        self._list.itemActivated.connect(lambda item: self.shown_requested.emit(self._list.row(item)))
        self._list.currentRowChanged.connect(self._enable)
        self._empty = note(_EMPTY)
        self._add = self._button("plus", "Add", "Add the method above, with its values and limits, as the last stage.")
        self._replace = self._button(
            "swap-horizontal", "", "Put the method above in place of the chosen stage.", "Replace the stage"
        )
        self._up = self._button("chevron-up", "", "Run the chosen stage earlier.", "Move up")
        self._down = self._button("chevron-down", "", "Run the chosen stage later.", "Move down")
        self._remove = self._button("delete-outline", "", "Take the chosen stage out.", "Remove the stage")
        self._run = self._button("play", "Run", "Run the stages one after another, as one run.", "Run recipe")
        self._load = self._button("folder-open-outline", "Load", "Load a recipe from a TOML file, or one of Hexmend's.")
        self._save = self._button(
            "content-save-outline", "", "Save the recipe as TOML, which hexmend smooth takes.", "Save"
        )
        self._menu = QMenu(self._load)
        self._menu.setToolTipsVisible(True)
        self._load.setMenu(self._menu)
        self._add.clicked.connect(self.add_requested)
        self._replace.clicked.connect(lambda: self.replace_requested.emit(self._list.currentRow()))
        self._up.clicked.connect(lambda: self._move(-1))
        self._down.clicked.connect(lambda: self._move(1))
        self._remove.clicked.connect(lambda: self.remove_requested.emit(self._list.currentRow()))
        self._run.clicked.connect(self.run_requested)
        self._save.clicked.connect(self.save_requested)
        self.set_shipped(())
        self._lay_out()
        self.set_stages(())

    def _button(self, picture: str, text: str, help: str, name: str = "") -> QPushButton:
        button = QPushButton(icon(picture), text)
        if not text:
            button.setFixedWidth(34)
        set_help(button, name or text, help)
        return button

    def _lay_out(self) -> None:
        head, edit, foot = QHBoxLayout(), QHBoxLayout(), QGridLayout()
        label = QLabel("Title")
        label.setBuddy(self._title)
        head.addWidget(label)
        head.addWidget(self._title, 1)
        edit.setSpacing(4)
        edit.addWidget(self._add, 1)
        for part in (self._replace, self._up, self._down, self._remove):
            edit.addWidget(part)
        foot.setSpacing(6)
        for column, part in enumerate((self._run, self._load)):
            part.setMinimumWidth(part.minimumSizeHint().width())
            foot.addWidget(part, 0, column)
            foot.setColumnStretch(column, 1)
        foot.addWidget(self._save, 0, 2)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(4)
        layout.addLayout(head)
        layout.addWidget(self._empty)
        layout.addWidget(self._list)
        layout.addLayout(edit)
        layout.addLayout(foot)

    def set_shipped(self, recipes: Iterable[tuple[str, Path]]) -> None:
        """Offer recipes that come with Hexmend: titles and files."""
        self._menu.clear()
        self._menu.addAction("From a &file…").triggered.connect(lambda: self.load_requested.emit())
        self._menu.addSeparator()
        for title, path in recipes:
            action = self._menu.addAction(title.replace("&", "&&"))
            action.setToolTip(f"{path.name}, which comes with Hexmend.")
            action.triggered.connect(lambda _=False, path=path: self.shipped_requested.emit(path))

    def set_stages(self, stages: Sequence[tuple[str, str]], title: str = "", usual: str = "") -> None:
        """Show the stages, without a signal.

        Parameters
        ----------
        stages : sequence of (words, help)
            In words, and what else there is to know of each.
        title, usual : str
            The recipe's, and the one that it has where that is "".
        """
        row = self._list.currentRow()
        self._list.blockSignals(True)
        self._list.clear()
        for at, (words, help) in enumerate(stages, start=1):
            item = QListWidgetItem(f"{at}  {words}")
            item.setToolTip(f"<qt>{escape(help)}</qt>")
            item.setSizeHint(QSize(1, self._list.fontMetrics().height() + 4))  # what is longer than the list ends in …
            self._list.addItem(item)
        self._list.setCurrentRow(min(row, len(stages) - 1))
        self._list.blockSignals(False)
        height = self._list.sizeHintForRow(0) if stages else 0
        self._list.setFixedHeight(height * min(len(stages), _SEEN) + 2 * self._list.frameWidth() + 2)
        self._list.setVisible(bool(stages))
        self._empty.setVisible(not stages)
        self._shown_title = title
        self._title.setText(title)
        self._title.setPlaceholderText(usual)
        self._title.setCursorPosition(0)
        self._enable()

    def choose(self, at: int) -> None:
        """Choose a stage; without a signal."""
        self._list.blockSignals(True)
        self._list.setCurrentRow(at)
        self._list.blockSignals(False)
        self._enable()

    def set_at_work(self, number: int | None) -> None:
        """Mark the stage at work, counted from 1, or none."""
        for at in range(self._list.count()):
            item = self._list.item(at)
            font = item.font()
            font.setBold(at + 1 == number)
            item.setFont(font)

    def set_editable(self, editable: bool) -> None:
        """Say whether stages can be changed and run: not while a run is under way."""
        self._editable = editable
        self._enable()

    def _move(self, by: int) -> None:
        at = self._list.currentRow()
        self.move_requested.emit(at, at + by)

    def _on_title(self) -> None:
        if self._title.text().strip() != self._shown_title:
            self.renamed.emit(self._title.text())

    def _enable(self) -> None:
        count, at = self._list.count(), self._list.currentRow()
        for part in (self._title, self._add, self._load):
            part.setEnabled(self._editable)
        for part in (self._replace, self._remove):
            part.setEnabled(self._editable and at >= 0)
        self._up.setEnabled(self._editable and at > 0)
        self._down.setEnabled(self._editable and 0 <= at < count - 1)
        self._run.setEnabled(self._editable and count > 0)
        self._save.setEnabled(count > 0)
