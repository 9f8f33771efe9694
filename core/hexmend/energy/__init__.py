"""Energy that the optimisers minimise, its derivatives, and policies for its regularisation parameter delta."""

from hexmend.energy.hessian import Hessian
from hexmend.energy.hex_energy import energies, objective
from hexmend.energy.mesh_energy import MeshEnergy
from hexmend.energy.motion import Motion
from hexmend.energy.norm import SQUARES, ObjectiveNorm
from hexmend.energy.regularisation import POLICIES, AdaptiveDelta, DeltaPolicy, FixedDelta
from hexmend.energy.sparsity import BlockSparsity

__all__ = [
    "POLICIES",
    "SQUARES",
    "AdaptiveDelta",
    "BlockSparsity",
    "DeltaPolicy",
    "FixedDelta",
    "Hessian",
    "MeshEnergy",
    "Motion",
    "ObjectiveNorm",
    "energies",
    "objective",
]
