"""The energy that the optimisers minimise, and the policies for its delta."""

from hexmend.energy.delta import FixedDelta
from hexmend.energy.hexahedral import energies, objective

__all__ = ["FixedDelta", "energies", "objective"]
