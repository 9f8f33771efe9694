"""Coordinates replaced in GRID cards of all layouts, and everything else as it was."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend import io
from hexmend.io import Original, write_as_given
from hexmend.mesh.hexahedron import UNIT_CUBE
from tests.core.io.kept import read_content

HEAD = ["$ our model", "SOL 101", "CEND", "SUBCASE 1", "  LOAD = 5", "BEGIN BULK"]
TAIL = ["CHEXA   1       1       1       2       3       4       5       6", "        7       8", "$ steel"]
TAIL += ["PSOLID  1       1", "MAT1    1       2.1+11          .3", "SPC1,1,123,1,2,$ held", "ENDDATA"]


def small(k, x, y, z):
    return [f"GRID    {k:<8}{'':8}{x:<8.4f}{y:<8.4f}{z:<8.4f}{'':8}{456:<8}"]


def large(k, x, y, z):
    return [f"GRID*   {k:>16}{'':16}{x:>16.9f}{y:>16.9f}*G{k}", f"*G{k:<6}{z:>16.9f}{'':16}{456:>16}"]


def free(k, x, y, z):
    return [f"GRID, {k}, , {x:.1f}, {y:.1f}, {z:.1f}, , 456"]


def long_free(k, x, y, z):
    return [f"grid,{k},,{x:.12f},{y:.12f},{z:.12f}"]


def large_free(k, x, y, z):
    return [f"GRID*,{k},,{x:.9f},{y:.9f}", f"*,{z:.9f}"]


def tabs(k, x, y, z):
    return [f"GRID\t{k}\t\t{x:.3f}\t{y:.3f}\t{z:.3f}"]


def commented(k, x, y, z):
    return [f"GRID    {k:<8}{'':8}{x:<8.4f}{y:<8.4f}{z:<.4f}   $ node {k}"]


def short(k, x, y, z):
    return [f"GRID    {k:<8}{'':8}{x:<8.4f}{y:<8.4f}{z if z else ''}"]


LAYOUTS = [small, large, free, long_free, large_free, tabs, commented, short]


def deck(tmp_path, layouts, breaks="\n", between=()):
    """A file with the nodes of a cube, and the mesh that is read from it."""
    lines, corners = list(HEAD), enumerate(UNIT_CUBE.tolist(), 1)
    for layout, (k, point) in zip(layouts, corners, strict=True):
        card = layout(k, *point)
        lines += [card[0], *between, *card[1:]]
    path = tmp_path / "in.bdf"
    return path, read_content(path, breaks.join([*lines, *TAIL, ""]).encode())


@given(
    st.lists(st.sampled_from(LAYOUTS), min_size=8, max_size=8),
    st.lists(st.integers(0, 23), max_size=12),
    st.lists(st.floats(-1e4, 1e4) | st.sampled_from([0.5, -0.25, 1e-30]), min_size=24, max_size=24),
    st.sampled_from(["\n", "\r\n"]),
    st.sampled_from([(), ("$ between",), ("",)]),
)
def test_cards_of_any_layout_get_new_coordinates_and_keep_the_rest(
    tmp_path_factory, layouts, which, new, breaks, between
):
    source, mesh = deck(tmp_path_factory.mktemp("deck"), layouts, breaks, between)
    points = mesh.points.copy()
    points.ravel()[which] = np.array(new)[which]
    target = source.with_name("out.bdf")
    written = write_as_given(target, mesh.with_points(points), Original(source, mesh))
    assert written.replaced, written.notes
    again = io.read(target)
    np.testing.assert_allclose(again.points, points, rtol=1e-10, atol=1e-30)
    np.testing.assert_array_equal(again.points[points == mesh.points], points[points == mesh.points])
    before, after = (path.read_bytes().decode().split(breaks) for path in (source, target))
    assert before[: len(HEAD)] == after[: len(HEAD)]
    assert before[-len(TAIL) - 1 :] == after[-len(TAIL) - 1 :]
    assert "\r" not in "".join(after)
    assert [line for line in before if "$" in line and "node" not in line] == [
        line for line in after if "$" in line and "node" not in line
    ]
    numbers = [word for line in after[len(HEAD) : -len(TAIL)] for word in line.replace(",", " ").split()]
    assert numbers.count("456") == sum(layout in (small, large, free) for layout in layouts)
    for k in np.flatnonzero((points == mesh.points).all(axis=1)):
        assert all(line in after for line in layouts[k](k + 1, *UNIT_CUBE[k].tolist()))


@pytest.mark.parametrize("layout", [small, large])
def test_blocks_of_cards_are_replaced_too(layout, tmp_path):
    grid = np.stack(np.meshgrid(*[np.arange(5.0)] * 3, indexing="ij"), -1).reshape(-1, 3)
    lines = [line for k, point in enumerate(grid.tolist(), 1) for line in layout(k, *point)]
    hexes = "CHEXA   1       1       1       26      31      6       2       27\n        32      7"
    path = tmp_path / "in.bdf"
    mesh = read_content(path, "\n".join(["BEGIN BULK", *lines, hexes, "ENDDATA"]))
    points = mesh.points + np.linspace(0, 0.1, 375).reshape(125, 3)
    written = write_as_given(tmp_path / "out.bdf", mesh.with_points(points), Original(path, mesh))
    assert written.replaced
    assert any("GRID*" in note for note in written.notes) == (layout is small)
    np.testing.assert_allclose(io.read(tmp_path / "out.bdf").points, points, rtol=1e-11)
