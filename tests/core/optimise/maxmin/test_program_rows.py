"""Rows of the linear program of a step: minus the slopes of each model along the directions of its nodes."""

import numpy as np
import pytest

from hexmend.optimise.maxmin.directions import StepDirections
from hexmend.optimise.maxmin.linear_program import LinearConstraints, build_program


def random_program(seed, n_nodes=12, models=40):
    """Some nodes with one to four directions each, and models of which many have a node twice or more."""
    random = np.random.default_rng(seed)
    nodes = np.sort(random.choice(n_nodes, 7, replace=False))
    of = np.repeat(np.arange(nodes.size), random.integers(1, 5, nodes.size))
    directions = StepDirections(of, random.normal(size=(of.size, 3)), random.normal(size=(of.size, 3)))
    at = random.integers(0, n_nodes, (models, 4)).astype(np.int32)
    at[: models // 4, 2:] = at[: models // 4, :2]
    slopes, gains = random.normal(size=(models, 4, 3)), random.integers(0, 2, models).astype(float)
    return nodes, directions, LinearConstraints(at, random.uniform(size=models), slopes, gains)


@pytest.mark.parametrize("seed", range(2))
def test_each_row_has_the_slopes_along_all_directions_of_its_nodes(seed):
    nodes, directions, models = random_program(seed)
    expected = np.zeros((len(models.nodes), directions.n_unknowns + 1))
    for row, (ends, slopes) in enumerate(zip(models.nodes, models.slopes, strict=True)):
        for column, node in enumerate(nodes[directions.node_index]):
            expected[row, column] = -sum(
                slopes[end] @ directions.projected[column] for end in np.flatnonzero(ends == node)
            )
    expected[:, -1] = models.has_gain
    matrix = build_program(nodes, directions, models, 0.1, False).matrix
    found = np.zeros(expected.shape)
    row = np.repeat(np.arange(len(found)), np.diff(matrix.start))
    assert len(set(zip(row, matrix.columns, strict=True))) == row.size  # each place once
    found[row, matrix.columns] = matrix.values
    np.testing.assert_allclose(found, expected, rtol=1e-12, atol=1e-13)
    of_nodes = np.isin(nodes[directions.node_index], models.nodes[0])
    assert np.diff(matrix.start)[0] == of_nodes.sum() + 1
