"""Linear programs that begin at the vertex where an earlier one ended: the same solution, in fewer steps."""

import numpy as np
import pytest
from scipy.optimize import linprog

from hexmend.optimise.maxmin import simplex
from hexmend.optimise.maxmin.directions import StepDirections
from hexmend.optimise.maxmin.linear_program import LinearConstraints, build_program, solve
from hexmend.optimise.maxmin.vertex import Vertex

AXES = np.concatenate([np.eye(3), -np.eye(3)])
COUNT = 30


def directions_of(nodes):
    steps = np.tile(AXES, (nodes.size, 1))
    return StepDirections(np.repeat(np.arange(nodes.size), 6), steps, steps)


def random_models(seed, nodes):
    """Models of the least and of bounds, each of four of some nodes, with random slopes."""
    rng = np.random.default_rng(seed)
    of = np.sort(np.array([rng.choice(nodes, 4, replace=False) for _ in range(2 * nodes.size)]))
    slack, slopes = rng.uniform(0, 0.2, len(of)), rng.normal(size=(len(of), 4, 3))
    return LinearConstraints(of, slack, slopes, (rng.uniform(size=len(of)) < 0.7).astype(float))


def changed(models, seed, share):
    """The same models after a step: slopes and slacks are others by a share."""
    rng = np.random.default_rng(seed)
    slack = models.slack * rng.uniform(1 - share, 1 + share, models.slack.size)
    slopes = models.slopes + share * rng.normal(size=models.slopes.shape)
    return LinearConstraints(models.nodes, slack, slopes, models.has_gain)


@pytest.fixture
def steps_of_solver(monkeypatch):
    """Counts the steps of the simplex."""
    counts, solve_once = [], simplex.GrowingProgram.solve

    def counting(program):
        found = solve_once(program)
        counts.append(program._solver.getInfo().simplex_iteration_count)  # noqa: SLF001
        return found

    monkeypatch.setattr(simplex.GrowingProgram, "solve", counting)
    return counts


@pytest.mark.parametrize("seed", range(2))
def test_the_vertex_of_another_program_changes_no_solution(seed):
    nodes = np.arange(10, 10 + COUNT)
    first, vertex = random_models(seed, nodes), Vertex()
    solve(nodes, directions_of(nodes), first, 0.1, vertex=vertex)
    others = np.arange(15, 15 + COUNT)  # some nodes and models are new, others have gone
    for models, of in ((changed(first, seed, 0.1), nodes), (random_models(seed + 50, others), others)):
        found = solve(of, directions_of(of), models, 0.07, vertex=vertex)
        program = build_program(of, directions_of(of), models, 0.07, False)
        matrix = np.zeros((models.slack.size, program.cost.size))
        rows = np.repeat(np.arange(models.slack.size), np.diff(program.matrix.start))
        np.add.at(matrix, (rows, program.matrix.columns), program.matrix.values)
        bounds = np.stack([program.lower, program.upper], axis=1)
        expected = linprog(program.cost, matrix, program.limits, bounds=bounds, method="highs-ipm").fun
        assert program.cost @ np.append(found.lengths, found.gain) == pytest.approx(expected, abs=1e-7)
        assert found.multipliers[models.has_gain > 0].sum() == pytest.approx(1)


def test_a_program_that_has_changed_little_takes_few_steps_from_the_last_vertex(steps_of_solver):
    nodes, vertex = np.arange(COUNT), Vertex()
    models = random_models(1, nodes)
    solve(nodes, directions_of(nodes), models, 0.1, vertex=vertex)
    again = changed(models, 2, 0.02)
    steps_of_solver.clear()
    solve(nodes, directions_of(nodes), again, 0.1)
    anew = sum(steps_of_solver)
    steps_of_solver.clear()
    solve(nodes, directions_of(nodes), again, 0.1, vertex=vertex)
    assert sum(steps_of_solver) < anew / 2
