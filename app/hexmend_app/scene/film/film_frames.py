"""Frames of a film of a run: iterations spread evenly over it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from hexmend_app.state.mesh.document import State
from hexmend_app.state.mesh.history import History, RunRecord


@dataclass(frozen=True, eq=False)
class FilmFrame:
    """A frame: a mesh with its texts.

    Parameters
    ----------
    caption : str
    state : State
        Of the same mesh in all frames, but for where its nodes are.
    """

    caption: str
    state: State


def chosen_iterations(history: History, record: RunRecord, frames: int) -> list[int]:
    """Choose the iterations of a film with a limited number of frames: the first, the last, and some between."""
    kept = history.kept(record)
    places = np.linspace(0, len(kept) - 1, min(frames, len(kept)))
    return kept[np.unique(places.round().astype(int))].tolist()


def film_frames(record: RunRecord, numbers: Sequence[int], state: Callable[[int], State]) -> Iterator[FilmFrame]:
    """Generate the frames of iterations; `state` returns the state of an iteration by its number."""
    for number in numbers:
        at = state(number)
        inverted = at.summary.inverted
        yield FilmFrame(
            f"{record.title}, iteration {number} of {record.newest}: q min {at.summary.q_min:.4f}, "
            f"{f'{inverted:,}' if inverted else 'none'} inverted",
            at,
        )
