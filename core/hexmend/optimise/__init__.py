"""Parts that methods are put together from, and the records of a run."""

from hexmend.optimise.iteration import Iteration, Outcome, Result, Step

__all__ = ["Iteration", "Outcome", "Result", "Step"]
