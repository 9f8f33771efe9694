"""The energy that the optimisers minimise, its derivatives, and the policies for its delta."""

from hexmend.energy.couplings import Couplings
from hexmend.energy.delta import POLICIES, AdaptiveDelta, DeltaPolicy, FixedDelta
from hexmend.energy.hexahedral import energies, objective
from hexmend.energy.mesh_energy import Hessian, MeshEnergy
from hexmend.energy.power import SQUARES, Power
from hexmend.energy.sliding import SlidingEnergy

__all__ = [
    "POLICIES", "SQUARES", "AdaptiveDelta", "Couplings", "DeltaPolicy", "FixedDelta", "Hessian", "MeshEnergy",
    "Power", "SlidingEnergy", "energies", "objective",
]  # fmt: skip
