"""Names of earlier versions go on being read."""

from __future__ import annotations

import importlib
import json
import subprocess
import sys
from dataclasses import replace
from enum import Enum

import pytest

import hexmend as hx
from hexmend import aliases
from hexmend.cli.main import main
from hexmend.parameters import declared, from_strings, from_values
from hexmend.run.breakpoints import Breakpoints
from hexmend.smoothers import METHODS

PARAMETERS = [(method, old, new) for method, names in aliases.PARAMETERS.items() for old, new in names.items()]


def test_a_module_in_a_package_with_an_old_name_is_the_same_module():
    old = importlib.import_module("hexmend.surface.classification")
    assert old.NodeClass is hx.boundary.NodeClass


@pytest.mark.parametrize(("old", "new"), aliases.MODULES.items())
def test_a_module_is_imported_by_its_old_name(old, new):
    assert importlib.import_module(old) is importlib.import_module(new)


@pytest.mark.parametrize(
    ("home", "name", "new"), [(home, *names) for home, table in aliases.NAMES.items() for names in table.items()]
)
def test_a_name_is_had_where_it_was(home, name, new):
    place, _, now = new.rpartition(".")
    found = getattr(importlib.import_module(home), name)
    assert found is getattr(importlib.import_module(place or home), now)
    assert name not in getattr(importlib.import_module(home), "__all__", ())  # read, but listed no more


def test_a_name_that_never_was_is_an_attribute_error():
    with pytest.raises(AttributeError, match="no attribute 'Sopt'"):
        hx.Sopt  # noqa: B018


def test_the_old_spelling_of_a_script_works_in_a_process_of_its_own():
    script = (
        "import hexmend as hx\n"
        "from hexmend.optimise import Stop\n"
        "from hexmend.fixing import with_pinned\n"
        "import hexmend.surface, hexmend.topology as t\n"
        "print(hx.Stop is Stop, hexmend.surface.Kind.__name__, t.Rows.__name__)\n"
    )
    ran = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60)
    assert (ran.stdout, ran.stderr) == ("True NodeClass CSR\n", "")


def test_renamed_keys_keep_the_new_value_where_both_are_there():
    assert aliases.renamed({"old": 1, "other": 2}, {"old": "new"}) == {"new": 1, "other": 2}
    assert aliases.renamed({"old": 1, "new": 3}, {"old": "new"}) == {"new": 3}


def another_value(method, name):
    """A value that is not the default."""
    one = next(one for one in declared(METHODS[method]) if one.name == name)
    return one.low if one.default != one.low else one.high


@pytest.mark.parametrize(("method", "old", "new"), PARAMETERS)
def test_a_parameter_is_read_by_its_old_name(method, old, new):
    cls, value = METHODS[method], another_value(method, new)
    expected = cls(**{new: value})
    assert expected != cls()
    assert cls(**{old: value}) == expected
    assert replace(cls(), **{old: value}) == expected
    assert from_strings(cls, {old: str(value)}) == from_strings(cls, {old.replace("_", "-"): str(value)}) == expected
    assert from_values(cls, {old: value}) == expected
    assert getattr(expected, old) == getattr(expected, new) == value
    assert hx.iterate(hx.gallery.make("cube", size=8), method, **{old: value}).smoother == expected


@pytest.mark.parametrize(("method", "old", "new"), PARAMETERS)
def test_a_parameter_is_written_by_its_new_name_alone(method, old, new):
    assert old not in METHODS[method]().values()
    assert old not in {one["name"] for one in METHODS[method].to_json()["parameters"]}


def test_of_an_old_and_a_new_name_in_a_file_the_new_one_counts():
    mend = METHODS["mend"]
    assert from_values(mend, {"max_p": 4.0, "highest_p": 8.0}) == from_values(mend, {"highest_p": 8.0, "max_p": 4.0})
    assert from_values(mend, {"max_p": 4.0, "highest_p": 8.0}).max_p == 4.0


@pytest.mark.parametrize("path", aliases.ATTRIBUTES)
def test_renamed_attributes_and_members_are_those_of_a_class(path):
    home, _, name = path.rpartition(".")
    cls = getattr(importlib.import_module(home), name)
    assert aliases.former_attributes(cls) is aliases.ATTRIBUTES[path]
    for old, new in aliases.ATTRIBUTES[path].items() if issubclass(cls, Enum) else ():
        assert getattr(cls, old) is cls[old] is cls[new] is getattr(cls, new)
        assert old not in {member.name for member in cls}  # read, but written no more


def test_an_attribute_that_never_was_is_an_attribute_error_of_its_class():
    with pytest.raises(AttributeError, match="'Mend' object has no attribute 'softnes'"):
        METHODS["mend"]().softnes  # noqa: B018


@pytest.mark.parametrize("setting", ["highest_p=4", "highest-p=4", "mend.highest_p=4", "max_p=4"])
def test_the_command_line_compares_methods_by_old_names_of_parameters(setting, tmp_path):
    hx.write(tmp_path / "a.vtk", hx.gallery.make("cube", size=8, scramble=0.2))
    said = ["compare", str(tmp_path / "a.vtk"), "-o", str(tmp_path), "--methods", "mend,laplacian", "--set", setting]
    assert main([*said, "--max-iterations", "1"]) == 0
    (record,) = (json.loads(path.read_text("utf-8")) for path in tmp_path.glob("*.json"))
    assert '"max_p": 4.0' in json.dumps(record)
    assert "highest" not in json.dumps(record)


def test_the_energy_of_a_mesh_has_the_methods_of_version_0_1():
    mesh = hx.gallery.make("cube", size=8, scramble=0.2)
    energy = hx.energy.MeshEnergy(mesh)
    assert energy.placed == energy.to_mesh_units
    assert energy.but == energy.with_objective
    assert energy.power is energy.norm
    assert energy.left_out is energy.omitted
    assert energy.least == energy.cube_value
    assert hx.energy.MeshEnergy(mesh, power=energy.norm, left_out=energy.omitted).norm == energy.norm
    assert energy.scaled(mesh.points).tolist() == energy.to_edge_units(mesh.points).tolist()


def test_read_takes_its_keyword_of_version_0_1(tmp_path):
    path = tmp_path / "a.vtk"
    hx.write(path, hx.gallery.make("cube", size=8))
    assert hx.read(path, nodes_without_place=True).n_hexes == 8


def test_a_format_of_a_plugin_may_have_its_keywords_of_version_0_1():
    from hexmend.io.base.format import Capability, Format

    old = Format("a", "A", (".a",), (), str, holds=frozenset({Capability.PINS}), names=frozenset("b"), cannot=len)
    new = Format(
        "a", "A", (".a",), (), str, capabilities=frozenset({Capability.FIXED_NODES}), stored_names=frozenset("b")
    )
    assert old == replace(new, limitations=len)


def test_steps_iterations_and_runs_have_the_attributes_of_version_0_1():
    mesh = hx.gallery.make("cube", size=8, scramble=0.2)
    quality = hx.measure(mesh.points, mesh.hexes)
    step = hx.Step(mesh.points, notes={"cuts": 2}, more=True, detour=True, figures=quality)
    assert step.diagnostics is step.notes == {"cuts": 2}
    assert (step.intermediate, step.infeasible, step.more, step.detour) == (True, True, True, True)
    assert step.quality is step.figures is quality
    run = hx.iterate(mesh, "laplacian", max_iterations=1)
    iteration = next(run)
    assert iteration.figures is iteration.quality
    assert iteration.notes is iteration.diagnostics
    assert run.reached is run.best
    assert run.limit == run.max_iterations
    assert iteration.power == hx.smoothers.METHODS["laplacian"]().power == iteration.norm
    assert Breakpoints(cuts=2).backtracks == 2
    assert not hasattr(step, "mroe")


def test_boundaries_take_their_keywords_of_version_0_1():
    mesh = hx.gallery.make("cube", size=8)
    boundary = hx.boundary.boundary_of(mesh, degrees=30)
    assert boundary.part is boundary.component
    assert hx.boundary.SlidingBoundary(mesh, degrees=30, tolerance=0.1).max_deviation == 0.1
    assert hx.boundary.surface_change(mesh, mesh, degrees=30) == hx.boundary.surface_change(mesh, mesh, 30)
