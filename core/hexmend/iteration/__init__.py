"""Records of iterations: steps, results, stopping criteria and the figures of a history."""

from hexmend.iteration.result import Iteration, Limits, Outcome, Result, StageResult, Step
from hexmend.iteration.stopping import Stop

__all__ = ["Iteration", "Limits", "Outcome", "Result", "StageResult", "Step", "Stop"]
