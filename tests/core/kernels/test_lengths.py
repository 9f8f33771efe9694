"""Kernels check the lengths of their arrays: an array that is too short would be read or written beyond its end.

The back line search, trial by trial.
"""

from typing import Any

import numpy as np
import pytest

from hexmend.kernels import closest_point, decimals, incidence, occlusion
from hexmend.kernels.line_search import LineSearch
from tests.core.kernels.arguments import arguments
from tests.core.kernels.arguments.rows import Row, common, of_another_mesh
from tests.core.kernels.arguments.signatures import KERNELS, Overload

MISFITS = (ValueError, TypeError, OverflowError)

kernels = pytest.mark.parametrize("name", KERNELS)


def row_of(name: str) -> Row:
    assert name in arguments(), f"{name} has no row: state its arguments in tests/core/kernels/arguments"
    return arguments()[name]


def call(name: str, overload: Overload, **other: Any) -> None:
    """Call a kernel with copies of its arrays, some arguments being others than those of the table."""
    row = row_of(name)
    given = {each: (common() | row.values | other)[each] for each in overload.names}
    for array in overload.arrays:
        if given[array] is not None:
            given[array] = overload.array(array, given[array])
    kernel = KERNELS[name][0]
    kernel(**given) if row.owner is None else kernel(row.owner, **given)


@kernels
def test_the_arguments_of_the_table_are_valid(name):
    row_of(name)
    for overload in KERNELS[name][1]:
        call(name, overload)


@kernels
def test_an_array_that_is_too_short_is_refused(name):
    row = row_of(name)
    for overload in KERNELS[name][1]:
        for array in overload.arrays.keys() - row.any_length:
            whole = overload.array(array, (common() | row.values)[array])
            for length in {len(whole) - 1} | ({0} if array not in row.empty else set()):
                with pytest.raises(MISFITS):
                    call(name, overload, **{array: whole[:length]})
                    pytest.fail(f"{name} takes {array} of length {length}: {len(whole)} is expected")


@kernels
def test_an_object_of_another_mesh_is_refused(name):
    row = row_of(name)
    for overload in KERNELS[name][1]:
        for each in of_another_mesh().keys() & set(overload.names) - overload.arrays.keys():
            if each in row.values:
                continue
            with pytest.raises(MISFITS):
                call(name, overload, **{each: of_another_mesh()[each]})
                pytest.fail(f"{name} takes {each} of another mesh")


def test_the_table_names_kernels_and_their_arrays_alone():
    for name, row in arguments().items():
        assert name in KERNELS
        for overload in KERNELS[name][1]:
            assert row.any_length | row.empty <= overload.arrays.keys(), name
            assert row.values.keys() <= set(overload.names), name


def test_a_count_with_which_no_kernel_can_work_is_refused():
    one, none = np.zeros(1), np.zeros((0, 3))
    with pytest.raises(ValueError, match="values: rows of `width`"):
        decimals.decimal_lines(one, 0, np.zeros(0, np.int64))
    with pytest.raises(ValueError, match="items: rows of `width`"):
        incidence.join(np.zeros(1, np.int32), np.zeros(2, np.int32), 0)
    with pytest.raises(ValueError, match="n: "):
        incidence.node_corners(np.zeros((0, 8), np.int32), -1)
    with pytest.raises(ValueError, match="side: "):
        occlusion.shine(none, np.zeros(1, np.int64), np.zeros(0, np.int64), none, none, 4, one[:0], one[:0])


def test_links_of_trees_that_lead_back_are_refused():
    points, pieces, boxes = np.zeros((1, 3)), np.zeros((1, 3), np.int32), np.zeros((6, 4))
    trees = closest_point.BoxTrees(points, pieces, boxes, np.zeros((1, 4), np.int32))
    found = np.full(1, -1, np.int32), np.zeros((1, 3)), np.zeros((1, 3))
    with pytest.raises(ValueError, match="links: "):
        closest_point.closest(trees, points, np.zeros(1, np.int32), 0.0, *found)


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
