"""What a suggestion is."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from hexmend.iteration import StoppingCriteria
from hexmend.smoothers import Smoother


@dataclass(frozen=True, eq=False)
class Suggestion:
    """Something to try after a run.

    Parameters
    ----------
    title : str
        A few words, as a button has them.
    text : str
        A sentence: what it does, and what it costs.
    gain : {"inverted", "objective", "q_min", "q_norm", "energy"}
        The figure of `Summary` that it betters, or at least keeps where `undo` is True; "energy" is the sum of eta(H)^p
        for the method's own p.
    smoother : Smoother
        The method to run, with its values.
    stop : StoppingCriteria
        Its limits.
    undo : bool
        Whether the run is to be taken back first: the method begins from the mesh as it was.
    unpin : (k,) int
        Nodes to be unpinned first.
    """

    title: str
    text: str
    gain: str
    smoother: Smoother
    stop: StoppingCriteria = field(default_factory=StoppingCriteria)
    undo: bool = False
    unpin: np.ndarray = field(default_factory=lambda: np.zeros(0, dtype=np.int64))
