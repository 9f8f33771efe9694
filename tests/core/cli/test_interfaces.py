"""Options of `smooth` for interfaces and sets, and what `smooth` and `info` print of materials."""

import json

import numpy as np
import pytest

from hexmend import io, read_recipe, smooth
from hexmend.cli.main import main
from tests.core.grids import grid, scrambled

CUBE = grid(4)
LOW = CUBE.points[CUBE.hexes].mean(axis=1)[:, 0] < 2
SETS = {"low": np.flatnonzero(LOW), "high": np.flatnonzero(~LOW)}
FLOOR = {"floor": np.flatnonzero(CUBE.points[:, 2] == 0), "roof": np.flatnonzero(CUBE.points[:, 2] == 4)}


@pytest.fixture
def path(tmp_path):
    path = tmp_path / "two.vtu"
    mesh = CUBE.replace(hex_sets=SETS, node_sets=FLOOR)
    moved = mesh.points + 0.3 * (mesh.materials.interface_nodes & ~mesh.topology.boundary)[:, None] * [0.3, 1, 0.5]
    io.write(path, scrambled(mesh.with_points(moved), 0.2))
    return path


def smoothed(path, *words):
    out = path.with_name("out.vtu")
    assert main(["smooth", str(path), "-o", str(out), *words]) == 0
    return io.read(out)


def test_interfaces_are_kept_and_the_report_has_the_volumes(path, tmp_path, capsys):
    report = tmp_path / "report.json"
    after, mesh = smoothed(path, "--json", str(report)), io.read(path)
    on = mesh.materials.interface_nodes
    np.testing.assert_array_equal(after.points[on], mesh.points[on])
    assert "2 materials: 9 nodes on their interfaces were kept." in capsys.readouterr().out
    volumes = json.loads(report.read_text())["materials"]
    assert list(volumes) == ["low", "high"]
    for volume in volumes.values():
        assert volume["volume_after"] == pytest.approx(volume["volume_before"], rel=1e-12)


@pytest.mark.parametrize(
    ("words", "on_itself"),
    [(["--interfaces", "free"], False), (["--interfaces", "slide"], True), (["--free", "low"], False)],
)
def test_options_let_interfaces_move(path, words, on_itself, capsys):
    after, mesh = smoothed(path, *words), io.read(path)
    on = mesh.materials.interface_nodes & ~mesh.topology.boundary
    assert np.linalg.norm(after.points - mesh.points, axis=1)[on].max() > 0.1
    assert (np.abs(after.points[on, 0] - 2).max() > 0.01) == on_itself  # without interface it ends at the lattice
    assert ("slid along them" if on_itself else "moved off them freely") in capsys.readouterr().out
    assert after.pinned is None


def test_the_message_tells_what_the_nodes_of_interfaces_did(tmp_path, capsys):
    flat, path = {"between": np.flatnonzero(CUBE.points[:, 0] == 2)}, tmp_path / "flat.vtu"
    one = {"one": np.flatnonzero((CUBE.points == 2).all(axis=1))}
    mesh = scrambled(CUBE, 0.2).replace(hex_sets=SETS, node_sets=flat | one)
    inside = (CUBE.points[:, :1] == 2) & ~CUBE.topology.boundary[:, None]
    io.write(path, mesh.with_points(np.where(inside, CUBE.points + [0, 0.15, 0.1], mesh.points)))
    smoothed(path, "--plane", "between")
    assert "9 of 9 nodes on their interfaces slid along them" in capsys.readouterr().out
    smoothed(path, "--interfaces", "slide", "--free", "one")
    assert "nodes on their interfaces moved, 1 of these off them freely" in capsys.readouterr().out
    smoothed(path, "--free", "one")
    assert "1 of 9 nodes on their interfaces moved off them freely" in capsys.readouterr().out


def test_info_names_the_materials_and_their_interface(path, capsys):
    main(["info", str(path)])
    assert "2 materials; 9 nodes on their interfaces are kept" in capsys.readouterr().out
    main(["info", str(path), "--json"])
    found = json.loads(capsys.readouterr().out)
    assert {name: entry["hexes"] for name, entry in found["materials"].items()} == {"low": 32, "high": 32}
    assert found["interface_nodes"] == 25


def test_options_replace_the_interfaces_of_a_recipe(path, tmp_path):
    choice = "free"
    recipe, given = tmp_path / "recipe.toml", tmp_path / "given.toml"
    recipe.write_text('format = 1\n[motion]\ninterfaces = "slide"\n[[stage]]\nmethod = "mend"\n')
    after = smoothed(path, "--recipe", str(recipe), "--interfaces", choice, "--save-recipe", str(given))
    np.testing.assert_array_equal(after.points, smoothed(path, "--interfaces", choice).points)
    assert read_recipe(given).rules.interfaces == choice
    again = smooth(io.read(path), read_recipe(recipe), interfaces=choice)
    np.testing.assert_array_equal(again.mesh.points, after.points)


def test_an_unknown_set_is_an_error_that_lists_the_sets(path, run_command):
    assert (
        "there is no set 'nowhere': there are 'floor', 'roof', 'low', 'high'"
        in run_command("smooth", path, "-o", path.with_name("out.vtu"), "--slide", "nowhere", status=3).err
    )
    assert not path.with_name("out.vtu").exists()
