"""Explanation of the step that a method makes for one node.

`explain` explains the step of any method; a `Sweep` goes through a sweep of a local method node by node.
"""

from hexmend_app.state.node_step.explain import explain
from hexmend_app.state.node_step.local import Sweep
from hexmend_app.state.node_step.record import NodeStep, Pull, StepStatus, Trial

__all__ = ["NodeStep", "Pull", "StepStatus", "Sweep", "Trial", "explain"]
