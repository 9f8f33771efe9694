"""Energies of boundaries whose nodes all slide by projection, those of flat patches and straight curves too."""

from hexmend.boundary import SlidingBoundary
from hexmend.energy import SQUARES, MeshEnergy, Motion, ObjectiveNorm


def projected_energy(sliding: SlidingBoundary, norm: ObjectiveNorm = SQUARES) -> MeshEnergy:
    """Energy of a sliding boundary, as ranks have it."""
    return MeshEnergy(sliding.mesh, norm, motion=Motion(sliding.mesh, sliding, sliding.nodes))
