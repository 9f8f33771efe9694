"""Nastran's bulk data: files that Gmsh 4.15 wrote in all three field formats, and meshes written and read again."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from hexmend import FileError, Mesh, io
from hexmend.io.formats.nastran.cards import real_field
from hexmend.mesh.hexahedron import UNIT_CUBE
from tests.core.grids import grid
from tests.core.io.kept import middles_are_in_the_middle, with_everything

GRIDS = "".join(f"GRID,{k + 1},,{x},{y},{z}\n" for k, (x, y, z) in enumerate(UNIT_CUBE.tolist()))
CUBE = f"BEGIN BULK\n{GRIDS}CHEXA,9,4,1,2,3,4,5,6\n,7,8\nENDDATA\n"


def read(text, tmp_path):
    (tmp_path / "a.bdf").write_text(text)
    return io.read(tmp_path / "a.bdf")


def test_hexes_of_27_nodes_are_written_with_20(tmp_path):
    io.write(tmp_path / "a.bdf", with_everything(27))
    mesh = io.read(tmp_path / "a.bdf")
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


@pytest.mark.parametrize(
    ("sets", "members", "said"),
    [
        ({"property 1": [0]}, {"property 1": [0], "property 2": [1]}, []),
        ({"property 2": [1]}, {"property 1": [0], "property 2": [1]}, []),
        (
            {"property 2": [0, 1], "property 3": [0]},
            {"property 2": [1], "property 3": [0]},
            ["element sets that overlap (property 2)"],
        ),
        (
            {"property 0": [0], "property 007": [1]},
            {"property 1": [0, 1]},
            ["element sets (property 0, property 007)"],
        ),
    ],
)
def test_elements_keep_their_properties_or_the_loss_is_reported(sets, members, said, tmp_path):
    mesh = grid(2, 1, 1).replace(hex_sets={name: np.array(rows) for name, rows in sets.items()})
    assert io.unsupported_data(tmp_path / "a.bdf", mesh) == said
    io.write(tmp_path / "a.bdf", mesh)
    assert {name: rows.tolist() for name, rows in io.read(tmp_path / "a.bdf").hex_sets.items()} == members


def test_rounded_digits_are_reported(tmp_path):
    words = "last digits of coordinates (a field holds 12 to 14)"
    fine = grid(2)
    for scale, said in ((0.25, []), (1e-60, []), (1 / 3, [words]), (1e-9 / 3, [words])):
        mesh = Mesh(fine.points * scale, fine.hexes)
        assert io.unsupported_data(tmp_path / "a.bdf", mesh) == said
        io.write(tmp_path / "a.bdf", mesh)
        assert np.array_equal(io.read(tmp_path / "a.bdf").points, mesh.points) == (not said)


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
