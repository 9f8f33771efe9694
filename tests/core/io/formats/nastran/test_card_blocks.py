"""Many Nastran cards give the same mesh in every layout, and errors in them name the line."""

import numpy as np
import pytest

from hexmend import Cells, FileError, io
from tests.core.grids import grid, scrambled
from tests.core.io.base.test_capabilities import quadratic
from tests.core.io.kept import assert_same


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


def read(tmp_path, text):
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
    assert_same(read(tmp_path, change(text)), read(tmp_path, text))


def test_hexes_with_some_mid_nodes_are_distinguished_from_those_with_all(tmp_path):
    mesh = quadratic(20)
    io.write(tmp_path / "a.bdf", mesh)
    head, element = (tmp_path / "a.bdf").read_text().split("CHEXA", 1)
    element = "CHEXA" + element.split("CHEXA")[0]
    lines = element.splitlines()
    partly = "\n".join([*lines[:2], lines[2][:8] + " " * 8 + lines[2][16:]]) + "\n"
    elements = [element, partly] * 40 + [element] * 40 + [partly] * 40
    numbered = [f"{one[:8]}{k + 1:<8}{one[16:]}" for k, one in enumerate(elements)]
    back = read(tmp_path, head + "".join(numbered) + "ENDDATA\n")
    assert (back.n_hexes, (back.mid_nodes[:, 0] >= 0).sum()) == (160, 80)
    assert any("80 elements have some of their mid-nodes only" in note for note in back.notes)


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        (
            "GRID*   100             ",
            "GRID*   1x0             ",
            "GRID in line 65 holds '1x0': expected a whole number",
        ),
        ("GRID*   100             " + " " * 16, "GRID*   100             2" + " " * 15, "GRID in line 65 is in the"),
        ("CHEXA   1000    ", "CHEXA   -1-0    ", "CHEXA in line 253 holds '-1-0': expected a whole number"),
    ],
)
def test_errors_name_the_line(old, new, words, text, tmp_path):
    assert old in text
    with pytest.raises(FileError) as error:
        read(tmp_path, text.replace(old, new))
    assert words in str(error.value)


def test_an_invalid_coordinate_is_reported_with_its_line(text, tmp_path):
    lines = text.splitlines(keepends=True)
    lines[65] = "*       far\n"
    with pytest.raises(FileError, match="GRID in line 65 holds 'far': expected a number"):
        read(tmp_path, "".join(lines))


@pytest.mark.parametrize("word", ["1.5DE1", "1.5E", "D1", "1.5+-1"])
def test_invalid_numbers_are_reported(word, tmp_path):
    with pytest.raises(FileError, match="expected a number"):
        read(tmp_path, f"GRID,1,,{word},0.,0.\n")
