"""Sentences in which mend reports its result."""

from __future__ import annotations

import numpy as np

from hexmend.mesh.mesh import Mesh
from hexmend.optimise.maxmin.slp import MaxMinOptimiser
from hexmend.optimise.maxmin.slp_step import ActiveCorners
from hexmend.quality import ElementQuality
from hexmend.quality.file_ids import hex_ids, with_ids
from hexmend.smoothers.mend.maxmin import locked_below
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
    pairs = [(of.scaled_jacobian.min(), of.q.min()) for of in (before, after)]
    (jacobian, q), (new_jacobian, new_q) = pairs
    return (
        f"{were} valid now: for that the minimum scaled Jacobian went from {jacobian:.4f} to {new_jacobian:.4f}, and "
        f"the least q(H) from {q:.4f} to {new_q:.4f}."
    )


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


def limit_message(optimiser: MaxMinOptimiser, active: ActiveCorners) -> str:
    """Tell which corners limit the least of the measure, and which are locked below it; "" where none limits it.

    Corners of several places reach the limit together, but hold each other within their own place alone.
    """
    count = len(active.hexes)
    if not count:
        return ""
    places = optimiser.corners.groups(8 * active.hexes + active.corners).max() + 1
    if count == 1:
        subject = "it cannot be raised further, in hex"
    elif places == 1:
        subject = f"{count} of them limit each other there, in the hexes"
    else:
        subject = f"it is limited by {count} corners at {places} separate places, in the hexes"
    measure = optimiser.corners.measure
    least = f"The minimum {measure.title} of the corners that can be moved is {measure.text(active.least)}"
    sentence = f"{least}: {subject} {_first_hexes(optimiser.mesh, active.hexes)}."
    locked = locked_below(optimiser, active)
    if not locked.size:
        return sentence
    which = "One corner is" if locked.size == 1 else f"{locked.size:,} corners are"
    lowest = optimiser.corners.values.ravel()[locked[0]]
    where = _first_hexes(optimiser.mesh, locked[:1] // 8)
    return f"{sentence} {which} locked below that: {measure.text(lowest)} at the lowest, in hex {where}."


def _first_hexes(mesh: Mesh, hexes: np.ndarray) -> str:
    """List the numbers of the first eight, each once, with those of the file."""
    return with_ids(list(dict.fromkeys(hexes[:8].tolist())), hex_ids(mesh))
