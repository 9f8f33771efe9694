"""Sweeps of local Newton steps (A.4) around poor hexes, which would limit the step length of all nodes."""

from __future__ import annotations

import numpy as np

from hexmend.arrays import mask
from hexmend.energy import LinearMotionEnergy, MeshEnergy
from hexmend.energy.hex_energy import as_omitted_corners
from hexmend.kernels import local
from hexmend.kernels.line_search import LineSearch
from hexmend.mesh.validation import as_bools, points_like
from hexmend.optimise.constrained_sweeps import ConstrainedSweeps, newton_steps

SEARCH = LineSearch(max_backtracks=60)


def local_sweeps(
    energy: MeshEnergy, x: np.ndarray, around: np.ndarray, omitted: np.ndarray, delta: float, sweeps: int
) -> np.ndarray:
    """Sweep over the inner nodes of some hexes and of their neighbours with local Newton steps.

    Nodes with a linear motion take part, those of a boundary that slides do not.

    Nodes at hexes with omitted corners stay: a local energy would count these corners.

    Parameters
    ----------
    energy : MeshEnergy
    x : (n, 3) float64
        Points in mean edge lengths.
    around : (m,) bool
        The hexes.
    omitted : (m,) uint8
        A bit for each corner that the energy omits.
    delta : float
        In cubes of the mean edge length of each node's patch, to which the kernel scales it.
    sweeps : int

    Returns
    -------
    (n, 3) float64
        Points after the sweeps.

    Raises
    ------
    MeshError
        For an array of another shape or type.
    """
    mesh = energy.mesh
    x = points_like(x, mesh.points.shape)
    around, omitted = as_bools(around, "around", mesh.n_hexes), as_omitted_corners(omitted, mesh.n_hexes)
    near = energy.ranks.complete(mask(mesh.hexes[around], mesh.n_nodes))
    near[mesh.hexes[near[mesh.hexes].any(axis=1)]] = True
    near[mesh.hexes[omitted != 0]] = False
    motion = mesh.linear_motion
    linear = np.zeros(mesh.n_nodes, dtype=bool) if motion is None else motion.marks(mesh.n_nodes)
    settings = local.NodeStepSettings(local.Direction.MODIFIED_NEWTON, delta, energy.norm, SEARCH, energy.target)
    constrained = None
    if (near & linear).any() and isinstance(energy, LinearMotionEnergy) and not energy.limits_moves:
        constrained = ConstrainedSweeps(energy.with_objective(energy.norm, omitted), near & linear)
    swept = x.copy()
    sweep = energy.sweep(swept, near & mesh.free & mesh.interior & ~linear)
    for _ in range(sweeps):
        sweep(settings)
        if constrained is not None:
            constrained(swept, delta, newton_steps, SEARCH)
    return swept
