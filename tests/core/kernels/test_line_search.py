"""The back line search, trial by trial."""

import pytest

from hexmend.kernels.line_search import LineSearch


@pytest.mark.parametrize("cuts", [0, 1, 5])
def test_a_search_tries_the_first_step_and_one_more_for_each_cut(cuts):
    tried = []

    def along(alpha):
        tried.append(alpha)
        return 1.0

    assert LineSearch(initial_step=2.0, backtrack_factor=0.5, max_backtracks=cuts)(along, 0.5, -1.0) == (0.0, cuts)
    assert tried == [2.0 * 0.5**cut for cut in range(cuts + 1)]


def test_a_step_that_descends_less_than_armijo_asks_is_not_accepted():
    search = LineSearch(initial_step=1.0, backtrack_factor=0.5, c1=0.1, max_backtracks=10)
    values = {1.0: 0.95, 0.5: 0.96, 0.25: 0.97}  # from 1 with slope -1: at most 0.9, 0.95 and 0.975 are enough
    assert search(values.__getitem__, 1.0, -1.0) == (0.25, 2)
    assert search(lambda alpha: 1.0 - 0.1 * alpha, 1.0, -1.0)[0] == 0.0  # exactly the bound is not enough
