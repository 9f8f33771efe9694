"""Averages along dual sheets against plain NumPy."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend.gallery import make
from hexmend.kernels import structure
from hexmend.target.edge_lengths import edge_numbers
from hexmend.target.sheets import Sheets


def averages(values, known, groups):
    """Mean of the means of the known values in the groups around each edge, and True for edges that have one."""
    marks = known[groups]
    number = marks.sum(axis=1)
    some = number > 0
    groups, number = groups[some], number[some]
    means = (values[groups] * marks[some]).sum(axis=1) / number
    total = np.bincount(groups.ravel(), np.repeat(means, 4), minlength=len(values))
    count = np.bincount(groups.ravel(), minlength=len(values))
    return total / np.maximum(count, 1), count


def filled(values, known, groups):
    """Values of unknown edges, front by front over all groups."""
    values, known = values.copy(), known.copy()
    while True:
        average, count = averages(values, known, groups)
        front = (count > 0) & ~known
        front[-1] = False
        if not front.any():
            return values, known
        values[front] = average[front]
        known |= front


def mesh_groups(size, seed):
    """Groups of the parallel edges of a mesh, values of its edges, and some that are known."""
    mesh = make("five-side", size=size)
    rng = np.random.default_rng(seed)
    groups, count = edge_numbers(mesh.topology).reshape(-1, 4).copy(), len(mesh.topology.edges)
    groups[rng.random(groups.shape) < 0.02] = count
    known = np.append(rng.random(count) < rng.choice([0.01, 0.3]), False)
    return mesh, groups, np.append(rng.uniform(-1, 1, count), 7.0), known


@given(st.integers(8, 200), st.integers(0, 10**6))
def test_averages_are_those_of_numpy(size, seed):
    _, groups, values, _ = mesh_groups(size, seed)
    average, count = np.empty(len(values)), np.empty(len(values), dtype=np.int32)
    structure.average_along_sheets(groups, values, average, count)
    expected, number = averages(values, np.arange(len(values)) < len(values) - 1, groups)
    np.testing.assert_allclose(average[:-1], expected[:-1], rtol=1e-14, atol=1e-15)
    np.testing.assert_array_equal(count[:-1], number[:-1])
    assert (average[-1], count[-1]) == (0, 0)


@given(st.integers(8, 200), st.integers(0, 10**6))
def test_fronts_are_those_of_numpy(size, seed):
    mesh, groups, values, known = mesh_groups(size, seed)
    values[-1] = 0
    expected, reached = filled(values, known, groups)
    Sheets(mesh, np.arange(mesh.n_hexes)).fill(values, known, groups)
    np.testing.assert_array_equal(known, reached)
    np.testing.assert_allclose(values, expected, rtol=1e-12, atol=1e-14)


def test_groups_that_name_no_edge_are_refused():
    values = np.zeros(3)
    for wrong in (-1, 3):
        groups = np.array([[0, 1, 1, wrong]], dtype=np.int32)
        with pytest.raises(ValueError, match="numbers of edges"):
            structure.average_along_sheets(groups, values, np.zeros(3), np.zeros(3, dtype=np.int32))
