"""Records of iterations: steps, results, stopping criteria and the figures of a history."""

from hexmend.iteration.result import Iteration, Result, StageResult
from hexmend.iteration.step import ActiveSet, Outcome, Step, map_steps
from hexmend.iteration.stopping import StoppingCriteria

__all__ = ["ActiveSet", "Iteration", "Outcome", "Result", "StageResult", "Step", "StoppingCriteria", "map_steps"]
