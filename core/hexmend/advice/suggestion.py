"""A suggestion for the next run."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from hexmend.iteration import StoppingCriteria
from hexmend.mesh.rules import MotionRules
from hexmend.smoothers import Smoother


@dataclass(frozen=True, eq=False)
class Suggestion:
    """A run to try next.

    Parameters
    ----------
    title : str
        A few words, for a button.
    text : str
        Effect and cost, as sentences.
    gain : {"inverted", "invalid", "objective", "q_min", "q_norm", "energy", "figures"}
        The figure of `Summary` that improves, or at least does not fall if `undo` is True; "energy" is the sum of
        eta(H)^p with the method's own p; "figures": of q min, q mean and the minimum scaled Jacobian none falls and at
        least one rises.
    smoother : Smoother
        The method with its parameters.
    stop : StoppingCriteria
        Its limits.
    undo : bool
        True if the last run is to be undone first.
    unpin : (k,) int
        Nodes to be unpinned first.
    rules : MotionRules, optional
        Rules of motion for the run; None for those of the last run.
    widen : bool
        True if the part of the mesh to which the last run was limited is to be larger.
    """

    title: str
    text: str
    gain: str
    smoother: Smoother
    stop: StoppingCriteria = field(default_factory=StoppingCriteria)
    undo: bool = False
    unpin: np.ndarray = field(default_factory=lambda: np.zeros(0, dtype=np.int64))
    rules: MotionRules | None = None
    widen: bool = False

    @property
    def releases(self) -> bool:
        """True if nodes that were fixed in the last run are free in this one."""
        return bool(self.unpin.size) or self.rules is not None or self.widen
