"""Frames of a film of a run: evenly spaced iterations."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from hexmend_app.state.mesh.document import State
from hexmend_app.state.mesh.hex_groups import invalid_counts
from hexmend_app.state.mesh.history import History, RunRecord


@dataclass(frozen=True, eq=False)
class FilmFrame:
    """Frame of a film: a state of the mesh with a caption.

    Parameters
    ----------
    title : str
        Title of the run.
    place : str
        Place of the frame in the run.
    state : State
        State of the mesh; frames differ in positions of nodes only.
    """

    title: str
    place: str
    state: State

    @property
    def captions(self) -> tuple[str, ...]:
        """Captions from the longest to the shortest."""
        return f"{self.title}, {self.place}: {self.quality}", f"{self.place}: {self.quality}", self.quality

    @property
    def quality(self) -> str:
        """q min and the number of invalid hexes, in words."""
        summary = self.state.summary
        return f"q min {summary.q_min:.4f}, {invalid_counts(summary.inverted, summary.invalid)}"


def chosen_iterations(history: History, record: RunRecord, frames: int) -> list[int]:
    """Return the numbers of at most `frames` recorded iterations, including the first and the last."""
    recorded = history.recorded_numbers(record)
    positions = np.linspace(0, len(recorded) - 1, min(frames, len(recorded)))
    return recorded[np.unique(positions.round().astype(int))].tolist()


def film_frames(record: RunRecord, numbers: Sequence[int], state: Callable[[int], State]) -> Iterator[FilmFrame]:
    """Generate the frames of iterations; `state` returns the state of an iteration by its number."""
    for number in numbers:
        yield FilmFrame(record.title, _place(record, number), state(number))


def _place(record: RunRecord, number: int) -> str:
    return record.label(number) if record.holds_times else f"iteration {number} of {record.newest}"
