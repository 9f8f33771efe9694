"""Energy of a mesh that is divided among ranks, as a function of the free nodes that this rank owns."""

from __future__ import annotations

from functools import cached_property

import numpy as np

from hexmend.arrays import index_of
from hexmend.energy import MeshEnergy, Motion, ObjectiveNorm
from hexmend.energy.norm import SQUARES
from hexmend.mesh.mesh import Mesh
from hexmend.ranks.rank_part import RankPart

#: Halvings of an interval in which a value of a given order is searched.
_HALVINGS = 60


class RankEnergy(MeshEnergy):
    """Energy of a divided mesh: values and slopes of the whole mesh, gradients of the rank's own nodes.

    All ranks call the methods together.

    Parameters
    ----------
    part : RankPart
    norm, omitted, motion
        See `MeshEnergy`.
    """

    def __init__(
        self,
        part: RankPart,
        norm: ObjectiveNorm = SQUARES,
        omitted: np.ndarray | None = None,
        motion: Motion | None = None,
    ):
        super().__init__(part.mesh, norm, omitted, motion or Motion(part.mesh, owned=part.owned))
        self.part, self.ranks, self.counted = part, part.ranks, part.counted

    @property
    def n_hexes(self) -> int:
        return self.part.n_hexes

    @cached_property
    def precision(self) -> type:
        narrow = super().precision is np.float32
        return np.float64 if self.ranks.any(not narrow) else np.float32

    def smallest(self, values: np.ndarray, number: int, most: float) -> float:
        if self.count(values <= most) <= number:
            return most
        low, high = self.ranks.least(float(values.min(initial=most))), most
        for _ in range(_HALVINGS):
            middle = (low + high) / 2
            low, high = (low, middle) if self.count(values <= middle) > number else (middle, high)
        return high

    def on_part(self, part: Mesh, hexes: np.ndarray, nodes: np.ndarray, x: np.ndarray | None = None) -> RankEnergy:
        whole, moving = self.part, np.zeros(self.mesh.n_nodes, dtype=bool)
        moving[nodes] = part.free
        number = np.where(moving, index_of(nodes, self.mesh.n_nodes), -1)
        part._set(mean_edge_length=self.unit)
        own = RankPart(
            part, whole.ranks.part(number), whole.nodes[nodes], whole.owned[nodes], whole.counted[hexes], whole.n_hexes
        )
        energy = RankEnergy(own, self.norm, self.omitted[hexes])
        self._give_to_part(energy, hexes)
        return energy
