"""Messages of a run about changes of the method and about the iteration that is kept.

Messages about the interfaces between the materials of a mesh.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from hexmend.mesh.mesh import Mesh
from hexmend.mesh.solid_cells import nouns
from hexmend.parameters import declared
from hexmend.quality import ElementQuality, locked_hexes
from hexmend.quality.file_ids import name_cells
from hexmend.quality.material_volumes import MaterialVolume
from hexmend.run.recipe import Stage
from hexmend.terminal_text import count_phrase

#: Invalid hexes that a message names.
_NAMED = 8


def describe_change(old: Stage, new: Stage) -> str:
    """Describe the differences between a stage and its replacement.

    >>> from hexmend.smoothers import METHODS
    >>> local, soft = METHODS["local-sd"](), METHODS["local-sd"](p=4)
    >>> describe_change(Stage(local), Stage(soft))
    'p = 4 instead of 2'
    >>> describe_change(Stage(METHODS["laplacian"]()), Stage(soft))
    'Local steepest descent (p = 4) takes over from Laplacian'
    """
    limits = _differences(old.stop.values(), new.stop.values())
    if type(old.smoother) is type(new.smoother):
        return ", ".join(_differences(old.smoother.values(), new.smoother.values()) + limits)
    defaults = {one.name: one.default for one in declared(new.smoother)}
    own = [f"{name} = {_format(value)}" for name, value in new.smoother.values().items() if value != defaults[name]]
    named = f" ({', '.join(own)})" if own else ""
    return ", ".join([f"{new.smoother.title}{named} takes over from {old.smoother.title}", *limits])


def invalid_phrase(inverted: int, invalid: int, words: tuple[str, str] = ("hex", "hexes")) -> str:
    """Say how many hexes of a result are inverted, and how many more are invalid between their corners.

    >>> invalid_phrase(0, 0), invalid_phrase(2, 3), invalid_phrase(0, 1)
    ('no hex is invalid', '2 hexes still inverted and 1 invalid inside', '1 hex still invalid inside')
    """
    if not invalid:
        return f"no {words[0]} is invalid"
    between = invalid - inverted
    if not inverted:
        return f"{count_phrase(between, *words)} still invalid inside"
    more = f" and {between:,} invalid inside" if between else ""
    return f"{count_phrase(inverted, *words)} still inverted{more}"


def name_invalid(mesh: Mesh, quality: ElementQuality) -> str:
    """Name the invalid hexes of a mesh, and say how many of them fixed nodes lock; "" where there are none.

    >>> from hexmend.gallery import make
    >>> from hexmend.quality import measure
    >>> mesh = make("cube", size=8)
    >>> name_invalid(mesh, measure(mesh.points, mesh.elements))
    ''
    """
    hexes = np.flatnonzero(quality.invalid)
    if not hexes.size:
        return ""
    more = f" and {hexes.size - _NAMED:,} more" if hexes.size > _NAMED else ""
    locked = int(np.count_nonzero(locked_hexes(mesh.points, mesh.elements, mesh.fixed, quality.inverted)))
    words = nouns(mesh.elements)
    reason = f"fixed nodes keep {count_phrase(locked, *words)} inverted" if locked else ""
    if locked < hexes.size:
        reason = f"{reason}, and no valid positions were found for the others" if locked else "no valid positions found"
    return f"Invalid {words[1]}: {name_cells(mesh, hexes[:_NAMED].tolist())}{more}; {reason}."


def kept_message(number: int) -> str:
    """
    >>> kept_message(3)
    'Iteration 3 was kept: later ones were worse.'
    """
    if not number:
        return "The mesh as given was kept: every iteration was worse."
    return f"Iteration {number} was kept: later ones were worse."


def _differences(old: Mapping[str, Any], new: Mapping[str, Any]) -> list[str]:
    changed = [name for name, value in new.items() if value != old[name]]
    return [f"{name} = {_format(new[name])} instead of {_format(old[name])}" for name in changed]


def _format(value: Any) -> str:
    return f"{value:g}" if isinstance(value, float) else str(value).lower() if isinstance(value, bool) else str(value)


#: Displacements below this share of the mean edge length are rounding.
_ROUNDING = 1e-9


def describe_interfaces(mesh: Mesh, interfaces: str = "") -> str:
    """Describe the interfaces of a mesh, and what its rules make of them; "" for one material.

    Parameters
    ----------
    mesh : Mesh
    interfaces : str
        Rule for the interfaces in place of that of the mesh; the sentence does not name options then.

    >>> from hexmend.gallery import make
    >>> cube = make("cube", size=64).replace(hex_sets={"low": np.arange(32), "high": np.arange(32, 64)})
    >>> describe_interfaces(cube)
    '2 materials; 9 nodes on their interfaces are kept (--interfaces slide or free lets them move).'
    """
    materials = mesh.materials
    if materials is None:
        return ""
    nodes = count_phrase(_inner_nodes(mesh).size, "node on their interfaces is", "nodes on their interfaces are")
    fates = {"keep": "kept", "slide": "to slide along them", "free": "free to move"}
    rule = interfaces or mesh.node_rules.interfaces
    options = " (--interfaces slide or free lets them move)" if rule == "keep" and not interfaces else ""
    return f"{len(materials)} materials; {nodes} {fates[rule]}{options}."


def describe_embedded(mesh: Mesh) -> str:
    """Tell that nodes of faces, edges and points inside the mesh stay; "" if there are none, or they may move."""
    n_embedded = int(np.count_nonzero(mesh.embedded & mesh.immovable))
    if not n_embedded:
        return ""
    stay = count_phrase(n_embedded, "node stays", "nodes stay")
    return f"{stay}: of faces, edges or points that the file has inside the mesh (--interfaces free lets them move)."


def interface_message(before: Mesh, after: Mesh, volumes: Mapping[str, MaterialVolume]) -> str:
    """Tell what a run did to the interfaces of a mesh; "" for one material.

    Parameters
    ----------
    before, after : Mesh
    volumes : mapping of str to MaterialVolume
        Volumes of the materials.
    """
    if before.materials is None:
        return ""
    nodes = _inner_nodes(before)
    displacements = np.linalg.norm(after.points[nodes] - before.points[nodes], axis=1)
    has_moved = displacements > _ROUNDING * (before.mean_edge_length or 1.0)
    moved = int(np.count_nonzero(has_moved))
    many = f"{len(before.materials)} materials"
    if not moved:
        kept = count_phrase(nodes.size, "node on their interfaces was", "nodes on their interfaces were")
        return f"{many}: {kept} kept."
    freely = int(np.count_nonzero(_is_free(before)[nodes[has_moved]]))
    some = f"moved, {freely:,} of these off them freely" if freely else "slid along them"
    motion = "moved off them freely" if freely == moved else some
    largest = max((abs(volume.change) for volume in volumes.values()), default=0.0)
    return (
        f"{many}: {moved:,} of {count_phrase(nodes.size, 'node')} on their interfaces {motion}; no material's volume "
        f"changed by more than {100 * largest:.2g} %."
    )


def _is_free(mesh: Mesh) -> np.ndarray:
    """Mark the nodes that no interface holds, (n,) bool: not those that move in their plane, or as one with others."""
    if mesh.interfaces is None:
        return np.ones(mesh.n_nodes, dtype=bool)
    rules, motion = mesh.node_rules, mesh.linear_motion
    free = np.zeros(mesh.n_nodes, dtype=bool) if rules.free is None else rules.free
    return free if motion is None else free & ~motion.marks(mesh.n_nodes)


def _inner_nodes(mesh: Mesh) -> np.ndarray:
    """Nodes of the interfaces that are not on the boundary, (k,) int64."""
    materials = mesh.materials
    if materials is None:
        return np.empty(0, np.int64)
    return np.flatnonzero(materials.interface_nodes & ~mesh.topology.boundary)
