"""Motion of nodes, freely, in planes and along lines, tied to others, and on a surface; reduction of Hessians to it."""

from hexmend.energy.motion.hessian_reduction import HessianReduction
from hexmend.energy.motion.motion import Motion

__all__ = ["HessianReduction", "Motion"]
