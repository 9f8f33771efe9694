"""Steps of any method on a mesh with a linear motion.

Global methods and mend know of linear constraints. Methods that move node after node make their sweep over the other
nodes, and a sweep of their own kind over the constrained ones follows. Steps of all other methods are projected onto
the admissible displacements.
"""

from __future__ import annotations

import numpy as np

from hexmend.arrays import mask
from hexmend.iteration import Outcome, Step
from hexmend.mesh.linear_motion.constrained_points import admissible_displacements
from hexmend.mesh.mesh import Mesh
from hexmend.quality import ElementQuality, measure
from hexmend.smoothers.base import Smoother, Steps, Sweep, figures_of_merit

#: Halvings of a projected step around hexes that it would invert, before their nodes stay.
HALVINGS = 4
#: Least rise of q_min or q_mean that counts, and projected steps without one after which the method ends.
RISE = 1e-6
PATIENCE = 10


def constrained_steps(smoother: Smoother, mesh: Mesh) -> Steps:
    """Return the steps of a method, which keep the linear motion of the mesh if it has one.

    Parameters
    ----------
    smoother : Smoother
    mesh : Mesh

    Returns
    -------
    Generator
        See `Smoother.steps`.
    """
    motion = mesh.linear_motion
    if motion is None or smoother.keeps_linear_motion:
        return smoother.steps(mesh)
    linear = mesh.free & motion.with_coupled(motion.marks(mesh.n_nodes))
    sweep = smoother.constrained_sweep(mesh, linear)
    if sweep is None:
        return _projected_steps(smoother, mesh.keeping_surface())
    return _steps_in_turns(smoother, mesh.keeping_surface(), linear, sweep)


def _steps_in_turns(smoother: Smoother, mesh: Mesh, linear: np.ndarray, sweep: Sweep) -> Steps:
    """Move the other nodes by the method, then the constrained ones by a sweep."""
    points, others = mesh.constrained(mesh.points), mesh.with_fixed(mesh.fixed | linear)
    any_other = smoother.movable(others).any()
    surface = _first_step(smoother, others.with_points(points)).surface if any_other else None
    yield Step(points, surface=surface)
    while True:
        step = _next_step(smoother, others.with_points(points)) if any_other else Step(points)
        if step is None:
            return Outcome.FINISHED
        points = mesh.constrained(sweep(step.points))
        if surface is not None:
            surface = _first_step(smoother, others.with_points(points)).surface
        yield Step(points, step.diagnostics, surface=surface)


def _projected_steps(smoother: Smoother, mesh: Mesh) -> Steps:
    """Move all nodes by the admissible part of their steps."""
    points = mesh.constrained(mesh.points)
    quality, idle = measure(points, mesh.elements), 0
    best = figures_of_merit(quality)
    yield Step(points)
    while idle < PATIENCE:
        step = _next_step(smoother, mesh.with_points(points))
        if step is None:
            return Outcome.FINISHED
        points, quality = _without_inversions(mesh, points, step.points - points, quality)
        now = figures_of_merit(quality)
        idle = 0 if (now > best + RISE).any() else idle + 1
        best = np.maximum(best, now)
        yield Step(points, step.diagnostics, quality=quality)
    return Outcome.NO_IMPROVEMENT


def _first_step(smoother: Smoother, mesh: Mesh) -> Step:
    """Return the step that a method yields before it moves a node."""
    steps = smoother.steps(mesh)
    first = next(steps)
    steps.close()
    return first


def _next_step(smoother: Smoother, mesh: Mesh) -> Step | None:
    """Return the first step of a method on a mesh; None if it makes none."""
    steps = smoother.steps(mesh)
    next(steps)
    step = next(steps, None)
    steps.close()
    return step


def _without_inversions(
    mesh: Mesh, points: np.ndarray, moves: np.ndarray, quality: ElementQuality
) -> tuple[np.ndarray, ElementQuality]:
    """Move by the admissible part of moves (n, 3), shortened around hexes that they would invert."""
    motion = mesh.linear_motion
    assert motion is not None  # such a mesh alone has constrained steps
    moves = admissible_displacements(motion, moves)
    for halving in range(HALVINGS + 2):
        moved = mesh.constrained(points + moves)
        after = measure(moved, mesh.elements)
        harmed = after.inverted & ~quality.inverted
        if not harmed.any():
            return moved, after
        near = motion.with_coupled(mask(mesh.elements[harmed], mesh.n_nodes))
        moves[near] *= 0.5 if halving < HALVINGS else 0.0
    return points, quality
