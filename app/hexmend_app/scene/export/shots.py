"""What a film of a run shows: iterations spread evenly over it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from hexmend_app.state.document import State
from hexmend_app.state.history import History, Record


@dataclass(frozen=True, eq=False)
class Shot:
    """One frame.

    Parameters
    ----------
    caption : str
    state : State
        Of the same mesh in all frames, but for where its nodes are.
    """

    caption: str
    state: State


def chosen(history: History, record: Record, frames: int) -> list[int]:
    """Numbers of the iterations that a film of at most so many frames shows: the first, the last, and between them."""
    kept = history.kept(record)
    places = np.linspace(0, len(kept) - 1, min(frames, len(kept)))
    return kept[np.unique(places.round().astype(int))].tolist()


def shots(record: Record, numbers: Sequence[int], state: Callable[[int], State]) -> Iterator[Shot]:
    """The frames, made one by one as they are asked for; `state` is that of an iteration by its number."""
    for number in numbers:
        at = state(number)
        inverted = at.summary.inverted
        yield Shot(
            f"{record.title}, iteration {number} of {record.newest}: q min {at.summary.q_min:.4f}, "
            f"{f'{inverted:,}' if inverted else 'none'} inverted",
            at,
        )
