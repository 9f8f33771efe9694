"""Energy that the optimisers minimise, and its derivatives."""

from hexmend.energy.hessian import Hessian
from hexmend.energy.hex_energy import energies, objective
from hexmend.energy.mesh_energy import MeshEnergy
from hexmend.energy.motion import Motion
from hexmend.energy.norm import SQUARES, ObjectiveNorm
from hexmend.energy.sparsity import BlockSparsity

__all__ = [
    "SQUARES",
    "BlockSparsity",
    "Hessian",
    "MeshEnergy",
    "Motion",
    "ObjectiveNorm",
    "energies",
    "objective",
]
