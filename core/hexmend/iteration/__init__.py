"""Records of iterations: steps, results, stopping criteria and the figures of a history."""

from hexmend.aliases import exports
from hexmend.iteration.result import ActiveSet, Iteration, Outcome, Result, StageResult, Step
from hexmend.iteration.stopping import StoppingCriteria

__all__ = ["ActiveSet", "Iteration", "Outcome", "Result", "StageResult", "Step", "StoppingCriteria"]

__getattr__ = exports(__name__)
