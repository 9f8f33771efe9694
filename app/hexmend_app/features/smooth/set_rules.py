"""Rules of motion of a single set: those that it has, and those that can be chosen for it."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from hexmend.errors import MeshError
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.rules import MotionRules
from hexmend.mesh.rules.named_sets import nodes_in_set, set_names
from hexmend.mesh.rules.resolution import normal_of_set
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
_PERIODIC = "Its nodes and those of {name} move as one."

#: Rule of a set: a field of `MotionRules` and, for a periodic pair, the name of the other set.
Rule = tuple[str, str]


class Choice(NamedTuple):
    """Choice for a set: its rules, text, help, and the reason for which it is not available, or ""."""

    rules: tuple[Rule, ...]
    text: str
    help: str
    problem: str = ""


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


def choice_of(rules: tuple[Rule, ...]) -> Choice:
    """Return the choice that shows the rules of a set."""
    if not rules:
        return Choice((), *map(tr, _NO_RULE))
    texts, helps = [], []
    for key, other in rules:
        text, help = _RULES.get(key, ("Periodic: {name}", _PERIODIC))
        texts.append(tr(text, name=other))
        helps.append(tr(help, name=other))
    return Choice(rules, ", ".join(texts), " ".join(helps))


def choices_of(mesh: Mesh, name: str, rules: tuple[Rule, ...]) -> list[Choice]:
    """Return the choices for a set of a mesh, with the present one.

    Parameters
    ----------
    mesh : Mesh
    name : str
    rules : tuple of Rule
        Present rules of the set.
    """
    if name not in set_names(mesh):
        return [choice_of(())] + [choice_of(rules)] * bool(rules)
    nodes = np.unique(nodes_in_set(mesh, name))
    choices = [choice_of(())]
    choices += [choice_of(((key, ""),))._replace(problem=_problem(mesh, name, nodes, key)) for key in _RULES]
    choices += [choice_of((("periodic", other),)) for other in _partners(mesh, name, nodes.size)]
    return choices if any(one.rules == rules for one in choices) else [*choices, choice_of(rules)]


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


def _problem(mesh: Mesh, name: str, nodes: np.ndarray, key: str) -> str:
    """Return the reason for which a rule is not available for a set of nodes (k,), or ""."""
    if not nodes.size:
        return tr("The set is empty.")
    if key == "free":
        pinned = mesh.pinned is not None and mesh.pinned[nodes].any()
        return "" if pinned or not mesh.topology.boundary[nodes].all() else tr("The boundary cannot be free.")
    if key == "slide":
        surface = (
            mesh.topology.boundary
            if mesh.materials is None
            else (mesh.topology.boundary | mesh.materials.interface_nodes)
        )
        return "" if surface[nodes].any() else tr("None of its nodes is on the boundary or an interface.")
    if key == "plane":
        try:
            normal_of_set(mesh, name)
        except MeshError:
            return tr("Its nodes are not in one plane.")
    return ""


def _partners(mesh: Mesh, name: str, count: int) -> list[str]:
    """Return the names of other sets that may be periodic with a set of so many nodes: of faces or nodes, as many."""
    if name in mesh.hex_sets or not count:
        return []
    others = [other for other in set_names(mesh) if other != name and other not in mesh.hex_sets]
    return [other for other in others if np.unique(nodes_in_set(mesh, other)).size == count]
