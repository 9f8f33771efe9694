"""Sentences in which mend reports its result."""

from __future__ import annotations

import numpy as np

from hexmend.energy import MeshEnergy
from hexmend.iteration import ActiveSet
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.topology.components import components_of_cells
from hexmend.quality import ElementQuality, measure
from hexmend.quality.file_ids import name_cells
from hexmend.smoothers.mend.floors import Floors, Values
from hexmend.terminal_text import count_phrase


def omission_message(by_fixed: int, others: int) -> str:
    """Tell how many hexes have corners that the energy omits.

    Parameters
    ----------
    by_fixed, others : int
        Numbers of hexes with corners that fixed nodes lock, and with other ones.
    """
    fixed = f"{count_phrase(by_fixed, 'hex has', 'hexes have')} corners that fixed nodes keep inverted"
    resisting = count_phrase(others, "hex has corners that stay inverted", "hexes have corners that stay inverted")
    clauses = [fixed] * bool(by_fixed) + [resisting] * bool(others)
    return f"Left out of the energy: {'; '.join(clauses)}."


def certified_message(before: ElementQuality, after: ElementQuality) -> str:
    """Tell how many hexes the last stage has made valid, and at what cost; "" where there are none."""
    count = before.n_invalid - after.n_invalid
    if count <= 0:
        return ""
    were = count_phrase(count, "hex that was invalid is", "hexes that were invalid are")
    figures = {"minimum scaled Jacobian": "scaled_jacobian", "least q(H)": "q"}
    pairs = {name: [f"{getattr(of, key).min():.4f}" for of in (before, after)] for name, key in figures.items()}
    cost = [f"the {name} went from {old} to {new}" for name, (old, new) in pairs.items() if old != new]
    return f"{were} valid now: for that {' and '.join(cost)}." if cost else f"{were} valid now."


def freed_message(locked: np.ndarray, inverted: np.ndarray) -> str:
    """Tell how many hexes that fixed nodes locked are free now that the boundary has slid; "" where there was none.

    Parameters
    ----------
    locked : (m,) uint8
        A bit for each corner that fixed nodes locked in inversion before the run.
    inverted : (m,) uint8
        A bit for each corner that is inverted now.
    """
    count = np.count_nonzero(locked)
    if not count:
        return ""
    left = np.count_nonzero(locked & inverted)
    rest = "none is left" if not left else count_phrase(left, "is left", "are left")
    had = f"{count_phrase(count, 'hex had', 'hexes had')} corners that fixed nodes keep inverted"
    return f"{had}: sliding freed {count - left:,}, {rest}."


def limit_message(mesh: Mesh, active: ActiveSet, least: float, title: str) -> str:
    """Tell which corners limit the least of a measure, and which are locked below it; "" where none limits it.

    Corners of several places reach the limit together, but hold each other within their own place alone.

    Parameters
    ----------
    mesh : Mesh
    active : ActiveSet
    least : float
    title : str
        Name of the measure.
    """
    hexes, count = active.hexes, len(active.hexes)
    if not count:
        return ""
    places = np.unique(components_of_cells(mesh.n_nodes, mesh.elements[np.unique(hexes)])).size
    if count == 1:
        subject = "it cannot be raised further, in hex"
    elif places == 1:
        subject = f"{count} of them limit each other there, in the hexes"
    else:
        subject = f"it is limited by {count} corners at {places} separate places, in the hexes"
    sentence = (
        f"The minimum {title} of the corners that can be moved is {least:.4g}: {subject} {_first_hexes(mesh, hexes)}."
    )
    locked = active.locked
    if not locked.size:
        return sentence
    which = "One hex has a corner" if locked.size == 1 else f"{locked.size:,} hexes have corners"
    return f"{sentence} {which} that fixed nodes lock below that, the lowest in hex {_first_hexes(mesh, locked[:1])}."


def balance_message(energy: MeshEnergy, floors: Floors, top: Values, shape: np.ndarray) -> str:
    """Say what was reached, which floors hold, and what they cost of q mean at the optimum of shape (n, 3)."""
    hexes = energy.mesh.elements
    kept, quality = floors.values, measure(floors.points, hexes)
    mean, without = energy.mean(quality.q), energy.mean(measure(shape, hexes).q)
    fixed = energy.ranks.least(float(quality.scaled_jacobian.min()))
    message = (
        f"The minimum scaled Jacobian of the corners that can be moved reached {max(top.jacobian, kept.jacobian):.4f}; "
        f"the result has at least {kept.jacobian:.4f}, and a q(H) of at least {kept.quality:.4f}."
    )
    if 0 < fixed < kept.jacobian - 5e-5:
        message += f" A corner that cannot be moved has {fixed:.4f}."
    cost = f"{without - mean:.4f}"
    if not float(cost) > 0:
        return message
    return f"{message} This costs {cost} in mean q."


def _first_hexes(mesh: Mesh, hexes: np.ndarray) -> str:
    """List the numbers of the first eight hexes, each once, with their numbers in the file."""
    return name_cells(mesh, list(dict.fromkeys(hexes[:8].tolist())))
