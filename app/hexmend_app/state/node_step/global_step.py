"""The step of one node by a global method: its part of the step of all nodes, Algorithm 3.3."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from hexmend.energy import MeshEnergy
from hexmend.kernels.line_search import LineSearch
from hexmend.mesh.mesh import Mesh
from hexmend.optimise.descent import descend
from hexmend.quality import measure
from hexmend.smoothers.global_.base import GlobalDescent
from hexmend_app.state.node_step.patch import Patch, curve_length
from hexmend_app.state.node_step.record import NodeStep, StepStatus, Trial

#: Samples of the energy along the direction; each needs the energy of the whole mesh.
_SAMPLES = 25


class _RecordedSearch(LineSearch):
    """A line search that records its trials."""

    def __init__(self, search: LineSearch):
        super().__init__(search.initial_step, search.backtrack_factor, search.c1, search.max_backtracks)
        self.trials: list[Trial] = []

    def __call__(self, energy_along: Callable[[float], float], value: float, slope: float) -> tuple[float, int]:
        """Find a step that descends, with the parameters and the result of `LineSearch`."""

        def recorded(alpha: float) -> float:
            energy = energy_along(alpha)
            self.trials.append(Trial(alpha, energy, value + self.c1 * alpha * slope))
            return energy

        return super().__call__(recorded, value, slope)


def global_step(smoother: GlobalDescent, mesh: Mesh, node: int) -> NodeStep:
    """Return the part of one node in the method's next step."""
    energy = MeshEnergy(mesh, smoother.norm)
    search = _RecordedSearch(smoother.line_search)
    x = energy.to_edge_units(mesh.points)
    delta = smoother.policy(energy).at(measure(mesh.points, mesh.hexes), energy.hex_sizes)
    patch = Patch(mesh, mesh.points, node, smoother.norm, delta, energy.unit)
    known = patch.fields() | {"method": smoother.name, "unit": energy.unit, "is_global": True}
    taken = descend(energy, x, delta, smoother.direction(), search)
    if taken is None or not taken.slope < 0:
        status = StepStatus.INFINITE if taken is None else StepStatus.STATIONARY
        known["energy"] = known["energy_after"] = np.inf if taken is None else taken.value
        return NodeStep(**known, after=patch.before, status=status)
    known["energy"], moved, row = taken.value, taken.alpha > 0, int(np.searchsorted(energy.nodes, node))
    curve = np.empty((_SAMPLES, 2))
    curve[:, 0] = np.linspace(0, curve_length(smoother.initial_step, taken.alpha), _SAMPLES)
    curve[:, 1] = [energy.value(energy.moved(x, taken.direction.vector, float(alpha)), delta) for alpha in curve[:, 0]]
    return NodeStep(
        **known,
        after=energy.to_mesh_units(taken.x)[node] if moved else patch.before,
        status=StepStatus.MOVED if moved else StepStatus.NO_DESCENT,
        energy_after=search.trials[-1].energy if moved else taken.value,
        direction=taken.direction.vector[row] * energy.unit,
        slope=taken.slope,
        alpha=taken.alpha,
        shift=taken.direction.shift,
        trials=tuple(search.trials),
        curve=curve,
        diagnostics=taken.diagnostics(delta),
    )
