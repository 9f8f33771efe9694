"""Target of the elements: the three lengths that each hex is to have along its own directions (Knupp's matrix W)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from hexmend.arrays import as_immutable
from hexmend.errors import MeshError
from hexmend.kernels.target import TargetMatrices
from hexmend.mesh.validation import as_reals, location

#: Lengths beyond which energies overflow or vanish.
MIN_LENGTH, MAX_LENGTH = 1e-100, 1e100


@dataclass(frozen=True, eq=False)
class Target:
    """Target matrices W = diag(lengths) of hexes, along the hexes' own directions.

    An optimiser with a target minimises the energies of S W^-1 in place of S, S being the edges at a corner
    (target-matrix optimisation, Knupp). A hex has no energy if it is a block with edges in the ratios of its lengths.

    Parameters
    ----------
    lengths : (m, 3) float64
        Lengths of each hex along x, y and z of its numbering (see `hexmend.mesh.hexahedron`), positive, in the mesh's
        unit of length; kept read-only.
    size_weight : float
        Weight of the size next to the shape, at least 0. With 0 only the ratios of a hex's lengths count.
    name : str
        Name for messages, such as "given-shape".

    Raises
    ------
    MeshError
        For another shape or type, and for values that are not positive and finite, or that overflow in energies.

    Examples
    --------
    >>> Target(np.ones((2, 3))).size_weight
    0.0
    """

    lengths: np.ndarray
    size_weight: float = 0.0
    name: str = ""

    def __post_init__(self) -> None:
        lengths = as_reals(self.lengths, "lengths of the target")
        if lengths.ndim != 2 or lengths.shape[1] != 3:
            raise MeshError(f"lengths of the target have shape {lengths.shape}: expected (m, 3), a row for each hex")
        wrong = np.argwhere(~((lengths >= MIN_LENGTH) & (lengths <= MAX_LENGTH)))
        if len(wrong):
            at = tuple(wrong[0].tolist())
            raise MeshError(
                f"a length of the target is {lengths[at]:g} at {location(('hex', 'direction'), at)}: "
                f"expected positive finite numbers from {MIN_LENGTH:g} to {MAX_LENGTH:g}"
            )
        if not (self.size_weight >= 0 and np.isfinite(self.size_weight)):
            raise MeshError(f"the weight of the size is {self.size_weight}: expected a number of at least 0")
        object.__setattr__(self, "lengths", as_immutable(lengths))
        object.__setattr__(self, "size_weight", float(self.size_weight))

    @cached_property
    def matrices(self) -> TargetMatrices:
        """The target as kernels take it, in the mesh's unit of length."""
        return TargetMatrices(1 / self.lengths, self.size_weight)

    def __deepcopy__(self, memo: dict[int, object]) -> Target:
        return self  # it is immutable

    def __getstate__(self) -> dict[str, object]:
        return {name: getattr(self, name) for name in ("lengths", "size_weight", "name")}

    def __setstate__(self, state: Mapping[str, object]) -> None:
        """Restore a pickled state; its array is writable and is made immutable again."""
        for name, value in state.items():
            object.__setattr__(self, name, as_immutable(value) if isinstance(value, np.ndarray) else value)
