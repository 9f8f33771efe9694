"""Repeated runs have the records of the original ones."""

import numpy as np
import pytest

from hexmend.gallery import make
from hexmend.run import StoppingCriteria, iterate
from hexmend.run.recipe import Stage
from hexmend.smoothers import METHODS
from hexmend_app.state.run.rerun import rerun

SHORT = StoppingCriteria(max_iterations=6, tolerance=0)


@pytest.fixture(scope="module")
def mesh():
    return make("bridge-sharp", size=300, scramble=0.4, seed=1)


def test_a_repeated_run_has_the_same_rows_and_the_requested_positions(mesh):
    run = rerun("mine", mesh, METHODS["local-sd"](), SHORT, keep=[2, 4], slot=3)
    iterations = list(iterate(mesh, METHODS["local-sd"](), SHORT))
    assert (run.name, run.slot, run.newest) == ("mine", 3, 6)
    assert [row["q_mean"] for row in run.rows[1:]] == [iteration.row()["q_mean"] for iteration in iterations]
    assert run.numbers().tolist() == [0, 2, 4, 6]
    np.testing.assert_allclose(run.points(4), iterations[3].points, atol=1e-6)
    assert np.array_equal(run.points(6), iterations[5].points)


@pytest.mark.parametrize("until", [0, 3])
def test_a_repeated_run_ends_after_the_given_iteration(mesh, until):
    run = rerun("mine", mesh, METHODS["local-sd"](), StoppingCriteria(max_iterations=10_000, tolerance=0), until=until)
    assert run.newest == until


def test_a_repeated_run_switches_the_method(mesh):
    run = rerun("mine", mesh, METHODS["local-sd"](), SHORT, changes=[(2, Stage(METHODS["laplacian"](), SHORT))])
    assert [row["method"] for row in run.rows] == ["local-sd"] * 3 + ["laplacian"] * 4


def test_a_branch_has_its_parent_iteration(mesh):
    first = rerun("first", mesh, METHODS["laplacian"](), SHORT)
    branch = rerun("second", mesh, METHODS["laplacian"](), SHORT, parent=(first, 2))
    assert branch.parent.name == "first 2"
