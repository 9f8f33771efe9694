"""Form for the rules of motion: a choice for the interfaces between materials, and one for each named set."""

from __future__ import annotations

from dataclasses import replace
from html import escape
from itertools import pairwise
from typing import Any

from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtWidgets import QGridLayout, QLineEdit, QVBoxLayout, QWidget

from hexmend.errors import MeshError
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.rules import MotionRules
from hexmend.mesh.rules.named_sets import set_names
from hexmend.mesh.rules.resolution import with_rules
from hexmend.run.interface_messages import describe_interfaces
from hexmend.terminal_text import printable
from hexmend_app.theme.palette import WORSE
from hexmend_app.theme.spacing import clear, fill
from hexmend_app.theme.style import bold, set_help, show_text, small_label
from hexmend_app.translation import tr
from hexmend_app.widgets.eliding_label import ElidingLabel
from hexmend_app.widgets.inputs.combo import ComboBox, FocusedWheel, let_shrink
from hexmend_app.widgets.inputs.segmented import Segmented
from hexmend_app.widgets.wording import counted

_INTERFACES = {
    "keep": ("Keep", "Interfaces are treated like the boundary: fixed if it is fixed, sliding if it slides."),
    "slide": ("Slide", "Nodes slide on the interfaces, even if the boundary is fixed."),
    "free": ("Free", "Nodes move as if the mesh had one material; interfaces lose their shape."),
}
#: Maximum number of rows; if there are more sets, a line filters them.
_MOST = 12
#: Rules of a single set: text and help.
_RULES = {
    "fix": ("Fixed", "Its nodes stay where they are."),
    "slide": ("Slides", "Its nodes slide on the surface, even if the rest of the boundary is fixed."),
    "free": ("Free", "Its nodes are neither pinned nor kept on an interface."),
    "plane": ("In its plane", "Its nodes move in the plane in which they lie."),
}
_NO_RULE = ("No rule", "Its nodes move like those of the rest of the mesh.")
_PERIODIC = ("Periodic: {name}", "Its nodes and those of {name} move as one.")
#: Rule of a set: a field of `MotionRules` and, for a periodic pair, the name of the other set.
Rule = tuple[str, str]


class RuleForm(QWidget):
    """Form for the rules of motion of the next run.

    Signals
    -------
    changed(MotionRules)
        The user has changed a rule.
    """

    changed = Signal(object)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._mesh: Mesh | None = None
        self._rules = MotionRules()
        self._names: tuple[str, ...] = ()
        self._rows: dict[str, _RuleBox] = {}
        self.interfaces = Segmented(
            tr("Interfaces"), [(key, tr(text), tr(help)) for key, (text, help) in _INTERFACES.items()]
        )
        self._found = small_label()
        self._found.setAccessibleName(tr("Interfaces found"))
        self._filter = QLineEdit()
        self._filter.setClearButtonEnabled(True)
        self._filter.setPlaceholderText(tr("Filter sets"))
        set_help(self._filter, tr("Filter sets"), tr("Show only sets whose names contain this text."))
        self._list = QWidget()
        self._grid = QGridLayout(self._list)
        self._problem = small_label("", WORSE)
        self._problem.setAccessibleName(tr("Problem of the rules"))
        self._more = small_label()
        self._lay_out()
        self.interfaces.chosen.connect(self._on_interfaces)
        self._filter.textChanged.connect(lambda _: self._fill())

    def _lay_out(self) -> None:
        self._grid.setContentsMargins(0, 0, 0, 0)
        self._grid.setHorizontalSpacing(8)
        self._grid.setVerticalSpacing(4)
        self._grid.setColumnStretch(0, 1)
        self._grid.setColumnStretch(1, 1)
        parts = (self._found, self.interfaces, self._filter, self._list, self._more, self._problem)
        fill(QVBoxLayout(self), *parts, margins=(0, 0, 0, 0), spacing=4)

    @property
    def offered(self) -> bool:
        """True if the mesh has interfaces or sets, or there are rules."""
        return bool(self._names or self._rules or (self._mesh is not None and self._mesh.materials is not None))

    @property
    def title(self) -> str:
        """Title of the form, with the number of rules."""
        count = len(self._rules.names) + (self._rules.interfaces != "keep")
        title = tr("Interfaces and sets")
        return f"{title} ({counted(count, 'rule')})" if count else title

    def show_rules(self, mesh: Mesh, rules: MotionRules) -> None:
        """Show rules of the sets of a mesh, without sending a signal."""
        names = tuple(dict.fromkeys([*set_names(mesh), *rules.names]))
        had_materials = self._mesh is not None and self._mesh.materials is mesh.materials
        same = names == self._names and had_materials
        if same and rules == self._rules:
            self._mesh = mesh
            return
        self._mesh, self._rules = mesh, rules
        if names != self._names:
            self._names = names
            self._filter.clear()
            self._fill()
        self._refresh()

    def _fill(self) -> None:
        """Make a row for each set whose name contains the text of the filter."""
        clear(self._grid)
        self._rows.clear()
        part = self._filter.text().casefold()
        matching = [name for name in self._names if part in name.casefold()]
        matching.sort(key=lambda name: name not in self._rules.names)  # those with rules first
        for row, name in enumerate(matching[:_MOST]):
            self._rows[name] = self._add_row(row, name)
        for before, box in pairwise([self._filter, *self._rows.values()]):
            self.setTabOrder(before, box)  # Qt adds new widgets at the end of the window's tab order
        self._filter.setVisible(len(self._names) > _MOST)
        self._list.setVisible(bool(self._rows))
        more = len(matching) - len(self._rows)
        show_text(self._more, tr("{count:,} more sets: filter them by name.", count=more) if more else "")
        self._show_choices()

    def _add_row(self, row: int, name: str) -> _RuleBox:
        label, box = ElidingLabel(), _RuleBox()
        label.setText(printable(name))
        label.setBuddy(box)
        label.setToolTip(f"<qt><b>{escape(name)}</b>: {escape(describe_set(self._mesh, name))}</qt>")
        set_help(box, tr("Rule of {name}", name=name), tr("Motion of the nodes of this set in a run."))
        box.chosen.connect(lambda rules: self._choose(name, rules))
        self._grid.addWidget(label, row, 0)
        self._grid.addWidget(box, row, 1)
        return box

    def _refresh(self) -> None:
        materials = self._mesh.materials
        for widget in (self.interfaces, self._found):
            widget.setVisible(materials is not None)
        self.interfaces.set_value(self._rules.interfaces)
        self._found.setText(describe_interfaces(self._mesh, self._rules.interfaces))
        show_text(self._problem, "")
        self._show_choices()

    def _show_choices(self) -> None:
        for name, box in self._rows.items():
            current = rules_of_set(self._rules, name)
            box.show_choices(choices_of(self._mesh, name, current), current)

    def _on_interfaces(self, key: str) -> None:
        self._change(MotionRules.from_values({**self._rules.values(), "interfaces": key}))

    def _choose(self, name: str, chosen: tuple[Rule, ...]) -> None:
        try:
            with_rules(self._mesh, with_set_rules(MotionRules(), name, chosen))
        except MeshError as error:
            self._show_choices()
            show_text(self._problem, tr("{error}.", error=str(error).rstrip(".")))
        else:
            self._change(with_set_rules(self._rules, name, chosen))

    def _change(self, rules: MotionRules) -> None:
        if rules != self._rules:
            self._rules = rules
            self.changed.emit(rules)
        self._refresh()


class _RuleBox(FocusedWheel, ComboBox):
    """Combo box of the rules that a set can have.

    Signals
    -------
    chosen(tuple of Rule)
    """

    chosen = Signal(object)

    def __init__(self, parent: QWidget | None = None):
        super().__init__(parent)
        self._choices: list[tuple[Rule, ...]] = []
        let_shrink(self, 8)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.activated.connect(lambda at: self.chosen.emit(self._choices[at]))

    def show_choices(self, choices: list[tuple[Rule, ...]], current: tuple[Rule, ...]) -> None:
        """Show the choices and the current one, without sending a signal."""
        self._choices = choices
        self.setFont(bold(self.font(), bool(current)))
        with QSignalBlocker(self):
            self.clear()
            for text, help in map(describe_rules, choices):
                self.add(text, help)
            self.setCurrentIndex(choices.index(current))


def rules_of_set(rules: MotionRules, name: str) -> tuple[Rule, ...]:
    """Return the rules of a set; a recipe may give it several.

    >>> rules_of_set(MotionRules(fix=("a",), periodic=(("b", "a"),)), "a")
    (('fix', ''), ('periodic', 'b'))
    """
    own = [(key, "") for key in _RULES if name in getattr(rules, key)]
    others = [(set(pair) - {name}).pop() for pair in rules.periodic if name in pair and len(set(pair)) > 1]
    return (*own, *(("periodic", other) for other in others))


def with_set_rules(rules: MotionRules, name: str, chosen: tuple[Rule, ...]) -> MotionRules:
    """Return rules of motion with the rules of one set replaced.

    Another set that was periodic with this set loses that rule.

    >>> with_set_rules(MotionRules(fix=("a",)), "a", (("slide", ""),)).values()
    {'slide': ['a']}
    """
    sets: dict[str, Any] = {key: tuple(one for one in getattr(rules, key) if one != name) for key in _RULES}
    pairs = [pair for pair in rules.periodic if name not in pair]
    for key, other in chosen:
        if key == "periodic":
            pairs = [*(pair for pair in pairs if other not in pair), (name, other)]
        else:
            sets[key] = (*sets[key], name)
    return replace(rules, periodic=tuple(pairs), **sets)


def describe_rules(rules: tuple[Rule, ...]) -> tuple[str, str]:
    """Return the text and the help of the rules of a set.

    >>> describe_rules((("fix", ""), ("periodic", "b")))[0]
    'Fixed, Periodic: b'
    """
    if not rules:
        text, help = _NO_RULE
        return tr(text), tr(help)
    described = [(_RULES.get(key, _PERIODIC), other) for key, other in rules]
    texts, helps = zip(
        *((tr(text, name=other), tr(help, name=other)) for (text, help), other in described), strict=True
    )
    return ", ".join(texts), " ".join(helps)


def choices_of(mesh: Mesh, name: str, rules: tuple[Rule, ...]) -> list[tuple[Rule, ...]]:
    """Return the rules that can be chosen for a set of a mesh, and its present `rules`.

    Not all of them suit the mesh: `hexmend.mesh.rules.resolution.with_rules` tells.
    """
    choices: list[tuple[Rule, ...]] = [()]
    names = set_names(mesh)
    if name in names:
        choices += [((key, ""),) for key in _RULES]
        if name not in mesh.hex_sets:
            choices += [(("periodic", other),) for other in names if other != name and other not in mesh.hex_sets]
    return choices if rules in choices else [*choices, rules]


def describe_set(mesh: Mesh, name: str) -> str:
    """Describe a set: its type and the number of its entries."""
    if name in mesh.node_sets:
        return tr("node set, {nodes}", nodes=counted(len(mesh.node_sets[name]), "node"))
    if name in mesh.hex_sets:
        return tr("hex set, {hexes}", hexes=counted(len(mesh.hex_sets[name]), "hex"))
    if name in mesh.side_sets:
        return tr("side set, {faces}", faces=counted(len(mesh.side_sets[name]), "face"))
    count = sum(len(cells.sets[name]) for cells in mesh.cells if name in cells.sets)
    return tr("set of {cells}", cells=counted(count, "other cell")) if count else tr("not a set of this mesh")
