"""Parts that methods are put together from, and the limits and records of a run."""

from hexmend.optimise.iteration import Iteration, Limits, Outcome, Result, StageResult, Step
from hexmend.optimise.stop import Stop

__all__ = ["Iteration", "Limits", "Outcome", "Result", "StageResult", "Step", "Stop"]
