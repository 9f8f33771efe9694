"""What a method would do to one node, and why: the node at hand of a sweep, laid open.

`explain` tells it for any method; a `Sweep` goes through one sweep of a local method node by node.
"""

from hexmend.aliases import exports
from hexmend.node_step import getme, laplacian
from hexmend.node_step.explain import explain
from hexmend.node_step.record import NodeStep, Pull, StepStatus, Trial
from hexmend.node_step.sweep import Sweep

__all__ = ["NodeStep", "Pull", "StepStatus", "Sweep", "Trial", "explain", "getme", "laplacian"]

__getattr__ = exports(__name__)
