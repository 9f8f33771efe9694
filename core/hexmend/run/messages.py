"""Messages of a run about changes of the method and about the iteration that is kept."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from hexmend.mesh.mesh import Mesh
from hexmend.mesh.solid_cells import nouns
from hexmend.parameters import declared
from hexmend.quality import ElementQuality, locked_hexes
from hexmend.quality.file_ids import name_cells
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
