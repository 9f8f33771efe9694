"""Nastran's bulk data: files that Gmsh 4.15 wrote in all three field formats, and meshes written and read again."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend import Cells, FileError, Mesh, io
from hexmend.doctor import examine
from hexmend.io import Original, write_as_given
from hexmend.io.formats.nastran.cards import real_field
from hexmend.mesh.hexahedron import UNIT_CUBE
from tests.core.grids import grid, scrambled
from tests.core.io.base.test_capabilities import quadratic
from tests.core.io.kept import assert_same, middles_are_in_the_middle, read_back, read_content, with_everything

GRIDS = "".join(f"GRID,{k + 1},,{x},{y},{z}\n" for k, (x, y, z) in enumerate(UNIT_CUBE.tolist()))
CUBE = f"BEGIN BULK\n{GRIDS}CHEXA,9,4,1,2,3,4,5,6\n,7,8\nENDDATA\n"


def read(text, tmp_path):
    return read_content(tmp_path / "a.bdf", text)


def test_hexes_of_27_nodes_are_written_with_20(tmp_path):
    mesh = read_back(tmp_path / "a.bdf", with_everything(27))
    assert ((mesh.mid_nodes >= 0).sum(axis=1) == 12).all()
    assert mesh.n_nodes == with_everything(27).n_nodes - 7 * mesh.n_hexes
    middles_are_in_the_middle(mesh)


@given(value=st.floats(-1e300, 1e300))
def test_a_field_holds_a_number_to_at_least_12_digits(value):
    text = real_field(value)
    assert len(text) <= 16
    assert "." in text
    sign, rest = text[:1], text[1:]
    exponent = max(rest.rfind("+"), rest.rfind("-"))
    number = float(sign + rest[:exponent] + "e" + rest[exponent:]) if exponent > 0 else float(text)
    assert number == pytest.approx(value, rel=1e-8, abs=0)


def test_real_numbers_in_the_formats_of_nastran_are_read(tmp_path):
    text = CUBE.replace("GRID,2,,1.0,0.0", "GRID,2,,10.-1,0.0").replace("GRID,3,,1.0,1.0", "GRID,3,,+.1+1,1.D0")
    text = "SOL 101\nCEND\nTITLE = cube $ none\n" + text + "GRID,99,,x,y,z\n"
    mesh = read(text.replace("BEGIN BULK", "BEGIN BULK\nMAT1,1,2.1+5,,.3"), tmp_path)
    np.testing.assert_array_equal(mesh.points, UNIT_CUBE)
    assert "1 MAT1" in mesh.notes[0]


def test_hexes_with_some_mid_nodes_are_read_with_their_corners(tmp_path):
    mesh = read(CUBE.replace(",7,8\n", ",7,8,,,1\n"), tmp_path)
    assert mesh.mid_nodes is None
    assert "some of their mid-nodes" in mesh.notes[0]


PROPERTIES = [
    ({"property 1": [0]}, {"property 1": [0], "property 2": [1]}, []),
    ({"property 2": [1]}, {"property 1": [0], "property 2": [1]}, []),
    (
        {"property 2": [0, 1], "property 3": [0]},
        {"property 2": [1], "property 3": [0]},
        ["element sets that overlap (property 2)"],
    ),
    ({"property 0": [0], "property 007": [1]}, {"property 1": [0, 1]}, ["element sets (property 0, property 007)"]),
]


@pytest.mark.parametrize(("sets", "members", "said"), PROPERTIES)
def test_elements_keep_their_properties_or_the_loss_is_reported(sets, members, said, tmp_path):
    mesh = grid(2, 1, 1).replace(hex_sets={name: np.array(rows) for name, rows in sets.items()})
    assert io.unsupported_data(tmp_path / "a.bdf", mesh) == said
    assert {name: rows.tolist() for name, rows in read_back(tmp_path / "a.bdf", mesh).hex_sets.items()} == members


def test_rounded_digits_are_reported(tmp_path):
    words = "last digits of coordinates (a field holds 12 to 14)"
    fine = grid(2)
    for scale, said in ((0.25, []), (1e-60, []), (1 / 3, [words]), (1e-9 / 3, [words])):
        mesh = Mesh(fine.points * scale, fine.hexes)
        assert io.unsupported_data(tmp_path / "a.bdf", mesh) == said
        assert np.array_equal(read_back(tmp_path / "a.bdf", mesh).points, mesh.points) == (not said)


def test_continuations_behind_all_cards_are_an_error_and_behind_theirs_are_read(tmp_path):
    mesh = grid(1)
    heads = [f"{'GRID*':8}{k:<16}{'':16}{x:<16}{y:<16}*G{k}" for k, (x, y, _) in enumerate(mesh.points, 1)]
    tails = [f"{f'*G{k}':8}{z:<16}" for k, (*_, z) in enumerate(mesh.points, 1)]
    hexes = [f"{'CHEXA':8}{1:<8}{1:<8}" + "".join(f"{k + 1:<8}" for k in mesh.hexes[0, :6]) + "+C1"]
    hexes += [f"{'+C1':8}" + "".join(f"{k + 1:<8}" for k in mesh.hexes[0, 6:])]
    path = tmp_path / "cards.bdf"
    path.write_text("\n".join(["BEGIN BULK", *sum(zip(heads, tails, strict=True), ()), *hexes, "ENDDATA\n"]))
    np.testing.assert_array_equal(io.read(path).points, mesh.points)
    path.write_text("\n".join(["BEGIN BULK", *heads, *tails, *hexes, "ENDDATA\n"]))
    with pytest.raises(FileError, match=r"line 10 continues a card as '\*G1', but GRID before it declares 'G8'"):
        io.read(path)


# Many Nastran cards give the same mesh in every layout, and errors in them name the line.


def many_cards():
    """Mesh of hexes and quads with several properties, whose coordinates have exponents without a letter."""
    bare = scrambled(grid(4), 0.3)
    quads = Cells("quad", bare.topology.boundary_faces, {}, {"property 9": np.arange(40)})
    mesh = bare.with_points(bare.points * 1e-7).replace(hex_sets={"property 5": np.arange(20)}, cells=(quads,))
    return mesh.replace(hex_data={"id": np.arange(64) * 3 + 1000}, node_data={"id": np.arange(125)[::-1] + 7})


@pytest.fixture
def text(tmp_path):
    io.write(tmp_path / "a.bdf", many_cards())
    return (tmp_path / "a.bdf").read_text()


def read_cards(tmp_path, text):
    (tmp_path / "b.bdf").write_text(text, newline="")
    return io.read(tmp_path / "b.bdf")


def commented(text):
    """The same cards with comments, so that each line is cut by itself."""
    return "".join(f"{line} $\n" for line in text.splitlines())


def with_blank_lines(text):
    return "".join(f"{line}\n$ a comment between\n\n" for line in text.splitlines())


def small(text):
    """Continuation lines without a sign, and trailing spaces."""
    return "".join(f"{line.replace('+       ', '        '):<72}behind\n" for line in text.splitlines())


def ended(text):
    return text + "GRID    99\n" * 50


@pytest.mark.parametrize("change", [commented, with_blank_lines, small, ended, lambda text: text.replace("\n", "\r\n")])
def test_the_same_cards_give_the_same_mesh(change, text, tmp_path):
    assert_same(read_cards(tmp_path, change(text)), read_cards(tmp_path, text))


def test_hexes_with_some_mid_nodes_are_distinguished_from_those_with_all(tmp_path):
    mesh = quadratic(20)
    io.write(tmp_path / "a.bdf", mesh)
    head, element = (tmp_path / "a.bdf").read_text().split("CHEXA", 1)
    element = "CHEXA" + element.split("CHEXA")[0]
    lines = element.splitlines()
    partly = "\n".join([*lines[:2], lines[2][:8] + " " * 8 + lines[2][16:]]) + "\n"
    elements = [element, partly] * 40 + [element] * 40 + [partly] * 40
    numbered = [f"{one[:8]}{k + 1:<8}{one[16:]}" for k, one in enumerate(elements)]
    back = read_cards(tmp_path, head + "".join(numbered) + "ENDDATA\n")
    assert (back.n_hexes, (back.mid_nodes[:, 0] >= 0).sum()) == (160, 80)
    assert any("80 elements have some of their mid-nodes only" in note for note in back.notes)


ERRORS = [
    ("GRID*   100 ", "GRID*   1x0 ", "GRID in line 65 holds '1x0': expected a whole number"),
    ("GRID*   100             " + " " * 16, "GRID*   100             2" + " " * 15, "GRID in line 65 is in the"),
    ("CHEXA   1000    ", "CHEXA   -1-0    ", "CHEXA in line 253 holds '-1-0': expected a whole number"),
]


@pytest.mark.parametrize(("old", "new", "words"), ERRORS)
def test_errors_name_the_line(old, new, words, text, tmp_path):
    assert old in text
    with pytest.raises(FileError) as error:
        read_cards(tmp_path, text.replace(old, new))
    assert words in str(error.value)


def test_an_invalid_coordinate_is_reported_with_its_line(text, tmp_path):
    lines = text.splitlines(keepends=True)
    lines[65] = "*       far\n"
    with pytest.raises(FileError, match="GRID in line 65 holds 'far': expected a number"):
        read_cards(tmp_path, "".join(lines))


@pytest.mark.parametrize("word", ["1.5DE1", "1.5E", "D1", "1.5+-1"])
def test_invalid_numbers_are_reported(word, tmp_path):
    with pytest.raises(FileError, match="expected a number"):
        read_cards(tmp_path, f"GRID,1,,{word},0.,0.\n")


# Coordinates replaced in GRID cards of all layouts, and everything else as it was.


HEAD = ["$ our model", "SOL 101", "CEND", "SUBCASE 1", "  LOAD = 5", "BEGIN BULK"]
TAIL = ["CHEXA   1       1       1       2       3       4       5       6", "        7       8", "$ steel"]
TAIL += ["PSOLID  1       1", "MAT1    1       2.1+11          .3", "SPC1,1,123,1,2,$ held", "ENDDATA"]


def small_fields(k, x, y, z):
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


def with_comment(k, x, y, z):
    return [f"GRID    {k:<8}{'':8}{x:<8.4f}{y:<8.4f}{z:<.4f}   $ node {k}"]


def short(k, x, y, z):
    return [f"GRID    {k:<8}{'':8}{x:<8.4f}{y:<8.4f}{z if z else ''}"]


LAYOUTS = [small_fields, large, free, long_free, large_free, tabs, with_comment, short]


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
    assert numbers.count("456") == sum(layout in (small_fields, large, free) for layout in layouts)
    for k in np.flatnonzero((points == mesh.points).all(axis=1)):
        assert all(line in after for line in layouts[k](k + 1, *UNIT_CUBE[k].tolist()))


@pytest.mark.parametrize("layout", [small_fields, large])
def test_blocks_of_cards_are_replaced_too(layout, tmp_path):
    grid = np.stack(np.meshgrid(*[np.arange(5.0)] * 3, indexing="ij"), -1).reshape(-1, 3)
    lines = [line for k, point in enumerate(grid.tolist(), 1) for line in layout(k, *point)]
    hexes = "CHEXA   1       1       1       26      31      6       2       27\n        32      7"
    path = tmp_path / "in.bdf"
    mesh = read_content(path, "\n".join(["BEGIN BULK", *lines, hexes, "ENDDATA"]))
    points = mesh.points + np.linspace(0, 0.1, 375).reshape(125, 3)
    written = write_as_given(tmp_path / "out.bdf", mesh.with_points(points), Original(path, mesh))
    assert written.replaced
    assert any("GRID*" in note for note in written.notes) == (layout is small_fields)
    np.testing.assert_allclose(io.read(tmp_path / "out.bdf").points, points, rtol=1e-11)


# Decks of several files, coordinate systems, and cards that hold grid points.


SYSTEMS = {
    "R": (np.eye(3) * 2, lambda p: p),
    "C": (np.eye(3), lambda p: [np.hypot(p[0], p[1]), np.rad2deg(np.arctan2(p[1], p[0])), p[2]]),
    "S": (np.eye(3), lambda p: [np.linalg.norm(p), np.rad2deg(np.arccos(p[2] / np.linalg.norm(p))),
                                np.rad2deg(np.arctan2(p[1], p[0]))]),
}  # fmt: skip


@pytest.mark.parametrize("by_points", [False, True])
@pytest.mark.parametrize("kind", SYSTEMS)
def test_grid_points_in_other_coordinate_systems_are_transformed_and_replaced(kind, by_points, tmp_path):
    """The system has its origin at (1, 2, 3), z along x, and x along y."""
    place = SYSTEMS[kind][1]
    local = [place(((x, y, z) @ np.array([[0, 0, 1], [1, 0, 0], [0, 1, 0]])).tolist()) for x, y, z in UNIT_CUBE + 0.5]
    grids = "".join(f"GRID*,{k + 1},7,{a!r},{b!r}\n*,{c!r}\n" for k, (a, b, c) in enumerate(np.array(local).tolist()))
    origin, on_z, in_xz = [1.0, 2.0, 3.0], [2.0, 2.0, 3.0], [1.0, 9.0, 3.0]
    if by_points:
        own = "".join(f"GRID,{k},,{x},{y},{z}\n" for k, (x, y, z) in enumerate([origin, on_z, in_xz], 101))
        system = f"{own}CORD1{kind},7,101,102,103\n"
    else:
        system = f"CORD2{kind},7,,{','.join(map(str, origin + on_z))}\n,{','.join(map(str, in_xz))}\n"
    text = CUBE.replace(GRIDS, system + grids)
    mesh = read(text, tmp_path)
    first = 3 if by_points else 0
    np.testing.assert_allclose(mesh.points[first:], UNIT_CUBE + 0.5 + origin, atol=1e-12)
    assert not by_points or mesh.pinned[:3].all()  # they define the system
    moved = mesh.points.copy()
    moved[first] += 0.125
    assert write_as_given(tmp_path / "b.bdf", mesh.with_points(moved), Original(tmp_path / "a.bdf", mesh)).replaced
    np.testing.assert_allclose(io.read(tmp_path / "b.bdf").points, moved, atol=1e-9)
    pairs = zip(text.split("\n"), (tmp_path / "b.bdf").read_text().split("\n"), strict=True)
    assert sum(a != b for a, b in pairs) <= 2


def test_a_point_of_an_unknown_system_is_refused_only_where_an_element_uses_it(tmp_path):
    mesh = read(CUBE.replace("CHEXA", "GRID,99,5,1.,2.,3.\nCHEXA", 1), tmp_path)
    assert "1 grid point that no element uses is in a coordinate system" in mesh.notes[0]
    with pytest.raises(FileError, match="refers to itself"):
        read(CUBE.replace("GRID,1,,", "CORD1R,5,1,2,3\nGRID,1,5,", 1), tmp_path)


@pytest.mark.parametrize("name", ["'sub/grids.bdf'", '"sub/grids.bdf"', "sub\\grids.bdf", "'sub/\ngrids.bdf'"])
def test_included_files_are_read_and_replaced_under_a_new_name(name, tmp_path):
    (tmp_path / "sub").mkdir()
    (tmp_path / "sub/grids.bdf").write_text(GRIDS, newline="\r\n")
    deck = CUBE.replace(GRIDS, f"$ ours\nINCLUDE {name} $ its points\n")
    mesh = read(deck, tmp_path)
    np.testing.assert_array_equal(mesh.points, UNIT_CUBE)
    moved = mesh.with_points(mesh.points + np.where(np.arange(8)[:, None] == 2, 0.25, 0))
    written = write_as_given(tmp_path / "b.bdf", moved, Original(tmp_path / "a.bdf", mesh))
    assert "sub/grids.bdf is written as sub/grids-b.bdf." in written.notes
    np.testing.assert_array_equal(io.read(tmp_path / "b.bdf").points, moved.points)
    new = (tmp_path / "sub/grids-b.bdf").read_bytes().decode()
    assert new == GRIDS.replace("GRID,3,,1.0,1.0,0.0", "GRID,3,,1.25,1.25,0.25").replace("\n", "\r\n")
    (tmp_path / "sub/grids.bdf").write_text(GRIDS.replace("GRID,3,,1.0", "GRID,3,,x"))
    with pytest.raises(FileError, match=r"GRID in line 3 of grids\.bdf holds 'x'"):
        io.read(tmp_path / "a.bdf")


def test_changes_below_what_fields_of_8_columns_hold_are_not_written(tmp_path):
    mesh = read(CUBE, tmp_path)
    for step, same in ((4e-6, True), (4e-5, False)):
        written = write_as_given(
            tmp_path / "b.bdf", mesh.with_points(mesh.points + step), Original(tmp_path / "a.bdf", mesh)
        )
        assert written.replaced
        assert ((tmp_path / "b.bdf").read_text() == (tmp_path / "a.bdf").read_text()) == same


def test_a_hex_of_more_than_20_nodes_is_an_error(tmp_path):
    with pytest.raises(FileError, match="CHEXA in line 10 has 22 nodes: expected 8 to 20"):
        read(CUBE.replace(",7,8\n", ",7,8,1,2,3,4,5,6\n,7,8,1,2,3,4,5,6\n"), tmp_path)


def test_grid_points_of_springs_and_rigid_elements_stay(tmp_path):
    io.write(tmp_path / "a.bdf", grid(3))
    text = (tmp_path / "a.bdf").read_text()
    inner = io.read(tmp_path / "a.bdf").node_data["id"][np.flatnonzero(grid(3).free)]
    text = text.replace(
        "ENDDATA", f"GRID,900,,9.,9.,9.\nCBUSH,901,1,{inner[0]},{inner[3]}\nRBE2,902,900,123,{inner[5]}\nENDDATA"
    )
    mesh = read(text, tmp_path)
    assert set(mesh.node_data["id"][mesh.pinned]) == {inner[0], inner[3], inner[5], 900}
    assert examine(mesh) == ()
