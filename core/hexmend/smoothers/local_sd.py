"""Local optimisation by steepest descent: Algorithm 3.2 with A.2 and A.5."""

from __future__ import annotations

from dataclasses import dataclass

from hexmend.energy import FixedDelta
from hexmend.kernels.local import steepest_descent_sweep
from hexmend.mesh import Mesh
from hexmend.optimise import Step
from hexmend.parameters import parameter
from hexmend.quality import measure
from hexmend.smoothers.smoother import Smoother, Steps, method


@method
@dataclass(frozen=True)
class LocalSteepestDescent(Smoother):
    """One line-searched step of steepest descent per free node, sweep after sweep."""

    name = "local-sd"
    title = "Local steepest descent"
    help = "Moves node after node down the gradient of its patch's energy. Smooths and untangles; reaches the optimum."
    source = "Wilson 3.2, Algorithms 3.2, A.2 and A.5"

    p: float = parameter(
        2.0, low=1, high=32, help="Exponent of the objective (3.3): the higher, the more the worst hexes count."
    )
    delta: float = parameter(
        0.01,
        low=0,
        high=10,
        unit="mean edge length³",
        help="Softness of the barrier (3.2) while any hex is inverted; then zero. Large values move the optimum.",
    )
    first_step: float = parameter(
        1.0, low=1e-6, high=1e3, unit="mean edge length", help="First trial step α of the line search (A.5)."
    )
    shrink: float = parameter(0.7, low=0.01, high=0.99, help="Factor λ by which the line search cuts a step (A.5).")
    c1: float = parameter(1e-4, low=0, high=0.5, help="Share c₁ of the slope that a step must descend (Armijo, A.5).")
    max_cuts: int = parameter(30, low=1, high=200, help="Cuts of a step after which the node is left where it is.")

    def steps(self, mesh: Mesh) -> Steps:
        policy = FixedDelta(self.delta)
        corners = mesh.topology.node_corners
        colours = mesh.topology.colouring(mesh.free)
        points = mesh.points
        yield Step(points)
        while True:
            delta = policy.at(measure(points, mesh.hexes))  # zero in the feasible region, 3.2.4
            points = points.copy()
            steepest_descent_sweep(
                points,
                mesh.hexes,
                corners.start,
                corners.items,
                colours.start,
                colours.items,
                delta,
                self.p,
                self.first_step,
                self.shrink,
                self.c1,
                self.max_cuts,
            )
            yield Step(points, {"delta": delta})
