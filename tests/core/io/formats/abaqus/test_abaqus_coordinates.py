"""Coordinates replaced in Abaqus decks: random layouts, fixed columns, parts and their instances."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend import io
from hexmend.io import Original, write_as_given
from hexmend.mesh.hexahedron import UNIT_CUBE

TAIL = "*Element, type=C3D8, elset=Body\n 5, 1, 2, 3, 4, 5, 6, 7, 8\n*Material, name=Steel\n*Elastic\n 210000., 0.3\n"
STEP = "** a step ** with stars\n*Step\n*Static\n0.1, 1.\n*Boundary\n 1, 1, 3\n*End Step"


def read(path: Path, text: str):
    path.write_bytes(text.encode())
    return io.read(path)


def replaced(source: Path, mesh, points) -> bytes:
    """The file with other coordinates; what it says when read again is checked."""
    target = source.with_name("out.inp")
    written = write_as_given(target, mesh.with_points(points), Original(source, mesh))
    assert written.replaced, written.notes
    # 20 characters hold 12 decimals at least: a sign, a digit and a point before them, and an exponent such as e-100.
    np.testing.assert_allclose(io.read(target).points, points, rtol=5e-13, atol=1e-300)
    return target.read_bytes()


@st.composite
def decks(draw):
    """A deck of one hex as users and programs write them, and the line of each node."""
    word = draw(st.sampled_from(["*NODE", "*Node", " * node", "*node, nset=All", "*NODE,\nNSET = All Nodes"]))
    lines = ["** ours: nothing, 1, 2, 3", "*HEADING", "kept as it is, 1, 2, 3"]
    lines += word.split("\n")
    rows, blank = [], st.sampled_from(["", " ", "\t", "    "])
    for k, point in enumerate(UNIT_CUBE, 1):
        if draw(st.booleans()):
            lines.append(draw(st.sampled_from(["** 9, 1., 2., 3.", "", "   "])))
        style = draw(st.sampled_from(["{!r}", "{:.0f}", "{:.0f}.", "{:e}", "{:12.5f}", "{:.3E}"]))
        words = [style.format(float(x)) for x in point]
        if draw(st.booleans()) and style == "{:e}":
            words = [one.replace("e", "D") for one in words]
        while words and float(words[-1].replace("D", "e")) == 0 and draw(st.booleans()):
            words.pop()
        words = ["" if float(one.replace("D", "e")) == 0 and draw(st.booleans()) else one for one in words]
        end = draw(st.sampled_from(["", "", ",", " "]))
        rows.append(len(lines))
        lines.append(draw(blank) + ",".join(draw(blank) + one + draw(blank) for one in [str(k), *words]) + end)
    breaks = draw(st.sampled_from(["\n", "\r\n"]))
    text = breaks.join([*lines, *(TAIL + STEP).split("\n")])
    return text + draw(st.sampled_from(["", breaks])), rows, breaks


@given(decks(), st.lists(st.integers(0, 7), max_size=8), st.lists(st.floats(-1e3, 1e3), min_size=3, max_size=3))
def test_random_decks_keep_all_but_the_coordinates_of_moved_nodes(tmp_path_factory, deck, which, new):
    text, rows, breaks = deck
    source = tmp_path_factory.mktemp("deck") / "in.inp"
    mesh = read(source, text)
    points = mesh.points.copy()
    points[which] = new
    data = replaced(source, mesh, points).decode()
    before, after = text.split(breaks), data.split(breaks)
    assert len(before) == len(after)
    moved = {rows[k] for k in range(8) if (points[k] != mesh.points[k]).any()}
    for k, (old, got) in enumerate(zip(before, after, strict=True)):
        if k in moved:
            assert got.split(",")[0].rstrip() == old.split(",")[0].rstrip()  # blanks behind a number without a comma
            assert got != old
        else:
            assert got == old


PARTS = """\
*Part, name=Block
*Node
{nodes}*Element, type=C3D8
 1, 1, 2, 3, 4, 5, 6, 7, 8
*End Part
*Assembly, name=All
{instances}*Node
 99, 1., 1., 1.
*End Assembly
*Material, name=Steel
"""
NODES = "".join(f"{k}, {x:g}, {y:g}, {z:g}\n" for k, (x, y, z) in enumerate(UNIT_CUBE, 1))


def written_as_given(source, mesh, points):
    """The deck with other coordinates, read again, and how it was written."""
    target = source.with_name("out.inp")
    written = write_as_given(target, mesh.with_points(points), Original(source, mesh))
    np.testing.assert_allclose(io.read(target).points, points, atol=1e-14)
    return target, written


@pytest.mark.parametrize("place", ["", "5., 0., 0.\n", "1., 2., 3.\n0., 0., 0., 0., 0., 1., 30.\n"])
def test_nodes_of_a_placed_part_are_replaced_in_the_part(place, tmp_path):
    instances = f"*Instance, name=One, part=Block\n{place}*End Instance\n"
    mesh = read(tmp_path / "a.inp", PARTS.format(nodes=NODES, instances=instances))
    points = mesh.points.copy()
    points[2:6] += [0.125, 0.25, -0.125]
    target, written = written_as_given(tmp_path / "a.inp", mesh, points)
    assert written.replaced
    given, got = (path.read_text().split("\n") for path in (tmp_path / "a.inp", target))
    assert [k for k, (a, b) in enumerate(zip(given, got, strict=True)) if a != b] == [4, 5, 6, 7]


def test_instances_that_move_alike_are_replaced_in_their_part_and_others_are_written_anew(tmp_path):
    instances = "".join(f"*Instance, name=I{k}, part=Block\n{3 * k}., 0., 0.\n*End Instance\n" for k in range(2))
    mesh = read(tmp_path / "a.inp", PARTS.format(nodes=NODES, instances=instances))
    points = mesh.points.copy()
    points[[3, 11]] += [0.1, 0.2, 0.3]
    assert written_as_given(tmp_path / "a.inp", mesh, points)[1].replaced
    points[3] += 0.1
    _, written = written_as_given(tmp_path / "a.inp", mesh, points)
    assert not written.replaced
    assert "instances of the part 'Block'" in written.notes[0]


def test_lines_with_more_and_fewer_fields_are_read_by_themselves(tmp_path):
    rows = [f"{k}, {x:.1f}, {y:.1f}, {z:.1f}" for k, (x, y, z) in enumerate(UNIT_CUBE, 1)]
    rows[1:4] = ["2, 1.0, 0.0, 0.0, 55.", "3, 1.0, 1.0", rows[3]]
    mesh = read(tmp_path / "in.inp", "*NODE\n" + "\n".join(rows) + "\n" + TAIL)
    np.testing.assert_array_equal(mesh.points, UNIT_CUBE)
    replaced(tmp_path / "in.inp", mesh, mesh.points + 0.25)
