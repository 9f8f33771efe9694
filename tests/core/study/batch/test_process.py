"""Tasks in their own process: every end is a row with its reason."""

import os
import sys

import numpy as np
import pytest

from hexmend import __version__, gallery, io, smooth
from hexmend.study.batch.case import Case
from hexmend.study.batch.plan import parse_plan
from hexmend.study.batch.process import run_task
from hexmend.study.batch.task import Task, content_hash, is_answer


def task(mesh, case=None, **values):
    """A task of a case on a mesh; without a case, `mend` a few times."""
    if case is None:
        (made,) = parse_plan('format = 1\nmethods = ["mend"]\nstop = { max_iterations = 4 }', mesh.parent).cases
        case = made.values()
    return Task(str(mesh), content_hash(mesh), case, **{"version": __version__} | values)


def trial(laboratory, does, **values):
    """The answer to a task that does this."""
    stage = {"method": "trial", "parameters": {"does": does}, "stop": {"max_iterations": 3}}
    one = task(laboratory.mesh(), {"recipe": None, "stages": [stage]}, **values)
    return run_task(one, memory_mb=2000, threads=1)


def test_a_result_is_that_of_the_method(tmp_path):
    mesh = gallery.make("bridge-sharp", size=864, scramble=0.4)
    io.write(tmp_path / "bridge.vtu", mesh)
    out = tmp_path / "out.vtu"
    row = run_task(task(tmp_path / "bridge.vtu", output=str(out)), memory_mb=0, threads=2)
    (case,) = parse_plan('format = 1\nmethods = ["mend"]\nstop = { max_iterations = 4 }', tmp_path).cases
    result = smooth(io.read(tmp_path / "bridge.vtu"), case.smoother, case.stop)
    assert (row["status"], row["reason"], row["threads"]) == ("done", "", 2)
    for key, value in result.before.to_dict().items():
        if key == "cells":
            continue
        assert row[key if key in row else f"{key}_before"] == value
    assert {key: row[f"{key}_after"] for key in ("inverted", "q_min", "objective")} == {
        key: getattr(result.after, key) for key in ("inverted", "q_min", "objective")
    }
    assert (row["iterations"], row["outcome"]) == (result.iterations, result.outcome.key)
    assert 0 < row["seconds"] < row["task_seconds"]
    assert 10 < row["peak_mb"] < 2000
    assert (io.read(out).points == result.mesh.points).all()
    assert is_answer(row)


def test_rules_of_motion_hold_in_the_process_of_a_task(tmp_path):
    mesh = gallery.make("bridge-sharp", size=864, scramble=0.4)
    mesh = mesh.replace(node_sets={"some": np.flatnonzero(~mesh.topology.boundary)[:50]})
    io.write(tmp_path / "bridge.vtu", mesh)
    text = 'format = 1\nmethods = ["mend"]\nstop = { max_iterations = 2 }\n[motion]\nfix = ["some"]'
    (case,) = parse_plan(text, tmp_path).cases
    out = tmp_path / "out.vtu"
    row = run_task(task(tmp_path / "bridge.vtu", case.values(), output=str(out)), memory_mb=0, threads=1)
    assert (row["status"], row["reason"]) == ("done", "")
    after, some = io.read(out), mesh.node_sets["some"]
    assert (after.points[some] == mesh.points[some]).all()
    assert not (after.points == mesh.points).all()


@pytest.mark.parametrize(("does", "status", "said"), [
    pytest.param("print", "done", "", marks=pytest.mark.slow),
    ("raise", "failed", "ValueError: it does not like this mesh"),
    ("crash", "lost", "Its process ended by SIGSEGV: it gave no reason"),
    pytest.param("vanish", "lost", "Its process ended with status 7: it gave no reason", marks=pytest.mark.slow),
])  # fmt: skip
def test_a_crash_of_a_method_affects_its_own_row_only(laboratory, does, status, said):
    row = trial(laboratory, does)
    assert (row["status"], row["reason"]) == (status, said)
    assert is_answer(row)


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="other systems do not hold memory so")
def test_the_memory_of_a_task_is_limited(laboratory):
    row = trial(laboratory, "eat", max_memory_mb=700)
    assert (row["status"], row["reason"]) == ("out of memory", "It needed more memory than it may have.")
    assert row["hexes"] == 8
    assert 100 < row["peak_mb"] < 700


@pytest.mark.slow
def test_a_task_that_takes_too_long_is_ended(laboratory):
    row = trial(laboratory, "wait", max_seconds=1.5)
    assert (row["status"], row["reason"]) == ("out of time", "It was not done within 1.5 s, and was ended.")
    assert laboratory.said("did") == []


@pytest.mark.slow
def test_a_cancelled_task_is_ended(laboratory):
    asked = []
    stage = {"method": "trial", "parameters": {"does": "wait"}, "stop": {}}
    one = task(laboratory.mesh(), {"recipe": None, "stages": [stage]})
    assert run_task(one, memory_mb=0, cancelled=lambda: asked.append(1) or len(asked) == 3) is None
    assert len(asked) == 3


@pytest.mark.parametrize(("values", "status", "said"), [
    ({"version": "0.0.1"}, "lost", "0.0.1 where it was planned"),
    pytest.param({"mesh_hash": "0"}, "lost", "cube.vtk is another file where the task ran than where it was planned.", marks=pytest.mark.slow),
    pytest.param({"case": {"recipe": None, "stages": [{"method": "nothing"}]}}, "failed", "there is no method 'nothing'", marks=pytest.mark.slow),
    ({"surface": "{mesh}", "surface_hash": "{hash}"}, "unreadable", "cube.vtk: "),
    pytest.param({"mesh": "/nowhere/cube.vtk"}, "lost", "Where the task ran: cube.vtk: there is no such file", marks=pytest.mark.slow),
    pytest.param({"output": "{mesh}/out.vtk"}, "lost", "out.vtk: cannot be written", marks=pytest.mark.slow),
])  # fmt: skip
def test_tasks_that_cannot_be_run_have_a_reason(laboratory, values, status, said):
    mesh = laboratory.mesh()
    text = {"{mesh}": str(mesh), "{hash}": content_hash(mesh)}
    for key, value in values.items():
        for word, meant in text.items() if isinstance(value, str) else ():
            values = values | {key: (value := value.replace(word, meant))}
    (case,) = parse_plan('format = 1\nmethods = ["mend"]', mesh.parent).cases
    known = {"mesh": str(mesh), "mesh_hash": text["{hash}"], "case": case.values(), "version": __version__}
    row = run_task(Task(**known | values), memory_mb=0)
    assert row["status"] == status
    assert said in row["reason"]


def test_the_key_depends_on_what_the_result_depends_on_alone(tmp_path):
    for name in ("a.vtk", "b.vtk", "c.mesh"):
        io.write(tmp_path / name, gallery.make("cube", size=8))
    io.write(tmp_path / "d.vtk", gallery.make("cube", size=27))
    (case,) = parse_plan('format = 1\nmethods = ["mend"]', tmp_path).cases
    a = task(tmp_path / "a.vtk", case.values())
    assert task(tmp_path / "b.vtk", case.values(), max_seconds=3, output="x.vtk").key == a.key
    others = [
        task(tmp_path / "c.mesh", case.values()),
        task(tmp_path / "d.vtk", case.values()),
        task(tmp_path / "a.vtk"),
        task(tmp_path / "a.vtk", Case("gone", case.smoother, None).values() | {"recipe": "mend"}),
        task(tmp_path / "a.vtk", case.values(), surface_hash="0"),
        task(tmp_path / "a.vtk", case.values(), version="0.0.1"),
    ]
    assert len({one.key for one in others} | {a.key}) == 7


def test_the_hash_of_a_mesh_includes_its_pieces(tmp_path):
    whole = '<VTKFile type="PUnstructuredGrid"><PUnstructuredGrid><Piece Source="a.vtu"/></PUnstructuredGrid></VTKFile>'
    (tmp_path / "whole.pvtu").write_text(whole)
    hashes = set()
    for size in (8, 27):
        io.write(tmp_path / "a.vtu", gallery.make("cube", size=size))
        hashes.add(content_hash(tmp_path / "whole.pvtu"))
    os.unlink(tmp_path / "a.vtu")
    assert len(hashes | {content_hash(tmp_path / "whole.pvtu")}) == 3
