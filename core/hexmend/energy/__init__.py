"""Energy that the optimisers minimise, its derivatives, and policies for its regularisation parameter delta."""

from hexmend.energy.hessian import Hessian
from hexmend.energy.hex_energy import energies, objective
from hexmend.energy.linear_motion_energy import LinearMotionEnergy, energy_of
from hexmend.energy.mesh_energy import MeshEnergy
from hexmend.energy.norm import SQUARES, ObjectiveNorm
from hexmend.energy.regularisation import POLICIES, AdaptiveDelta, DeltaPolicy, FixedDelta
from hexmend.energy.sliding_energy import SlidingEnergy
from hexmend.energy.sparsity import BlockSparsity

__all__ = [
    "POLICIES",
    "SQUARES",
    "AdaptiveDelta",
    "BlockSparsity",
    "DeltaPolicy",
    "FixedDelta",
    "Hessian",
    "LinearMotionEnergy",
    "MeshEnergy",
    "ObjectiveNorm",
    "SlidingEnergy",
    "energies",
    "energy_of",
    "objective",
]
