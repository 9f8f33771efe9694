"""Rules of motion of a single set: those that it has, and those that can be chosen for it."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from hexmend.mesh.mesh import Mesh
from hexmend.mesh.rules import MotionRules
from hexmend.mesh.rules.named_sets import set_names
from hexmend_app.translation import tr
from hexmend_app.widgets.wording import counted

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
