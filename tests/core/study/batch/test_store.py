"""Stored answers: reused or run again."""

import json

import pytest

from hexmend import FileError, gallery, io
from hexmend.study.batch.plan import find_meshes
from hexmend.study.batch.task import COLUMNS, Status, Store, Task, answer, is_answer

TASK = Task("/some/mesh.vtk", "0", {"recipe": None, "stages": []}, "0.1", max_seconds=5, max_memory_mb=100)


def kept(folder, task=TASK, status=Status.DONE, **figures):
    Store(folder).save(TASK, answer(status, **figures))
    return Store(folder).load(task)


def test_an_answer_survives_the_round_trip(tmp_path):
    row = answer(Status.DONE, hexes=8, q_min_after=1, objective_after=float("inf"), worse="q_min", task_seconds=0.5)
    Store(tmp_path).save(TASK, row)
    assert Store(tmp_path).load(TASK) == row
    assert row["objective_after"] is None
    assert [path.name for path in tmp_path.iterdir()] == [f"{TASK.key}.json"]


@pytest.mark.parametrize(("status", "changes", "holds"), [
    (Status.DONE, {"max_seconds": 1, "max_memory_mb": 1}, True),
    (Status.FAILED, {"max_seconds": 9}, True),
    (Status.UNREADABLE, {}, True),
    (Status.LOST, {}, False),
    (Status.TIME, {"max_memory_mb": 9}, True),
    (Status.TIME, {"max_seconds": 9}, False),
    (Status.MEMORY, {"max_seconds": 9}, True),
    (Status.MEMORY, {"max_memory_mb": 0}, False),
])  # fmt: skip
def test_a_failure_is_reused_while_its_limit_is_unchanged(tmp_path, status, changes, holds):
    task = Task(**{**vars(TASK), **changes})
    assert (kept(tmp_path, task, status) is not None) == holds


def test_failures_by_free_memory_are_run_again(tmp_path):
    task = Task(**{**vars(TASK), "max_memory_mb": 0})
    Store(tmp_path).save(task, answer(Status.MEMORY))
    assert Store(tmp_path).load(task) is None


def test_a_result_is_reused_while_its_mesh_exists(tmp_path):
    task = Task(**{**vars(TASK), "output": str(tmp_path / "out.vtk")})
    assert kept(tmp_path, task) is None
    (tmp_path / "out.vtk").touch()
    assert kept(tmp_path, task) is not None


@pytest.mark.parametrize("spoil", [
    lambda stored: None,
    lambda stored: [stored],
    lambda stored: stored | {"key": "0" * 32},
    lambda stored: stored | {"answer": None},
    lambda stored: stored | {"answer": stored["answer"] | {"status": "splendid"}},
    lambda stored: stored | {"answer": stored["answer"] | {"hexes": "8"}},
    lambda stored: stored | {"answer": stored["answer"] | {"hexes": True}},
    lambda stored: stored | {"answer": stored["answer"] | {"more": 1}},
    lambda stored: stored | {"answer": stored["answer"] | {"message": "a" * 1_000_000}},
    lambda stored: {"key": stored["key"], "answer": {}},
])  # fmt: skip
def test_files_without_an_answer_are_ignored(tmp_path, spoil):
    assert kept(tmp_path) is not None
    (path,) = tmp_path.iterdir()
    stored = json.loads(path.read_text())
    path.write_text(json.dumps(spoil(stored)))
    assert Store(tmp_path).load(TASK) is None
    path.write_text("[" * 100_000)
    assert Store(tmp_path).load(TASK) is None


def test_columns_have_types_that_both_tables_know():
    assert set(COLUMNS.values()) == {str, int, float}
    assert is_answer(answer(Status.FAILED, "It did not work."))


# Mesh files in folders.


def test_meshes_are_found_in_subfolders_and_cases_are_one_mesh(tmp_path):
    cube = gallery.make("cube", size=8)
    (tmp_path / "b").mkdir()
    io.write(tmp_path / "b/cube.vtu", cube)
    io.write(tmp_path / "a.msh", cube)
    (tmp_path / ".hidden").mkdir()
    io.write(tmp_path / ".hidden/cube.vtu", cube)
    case = tmp_path / "case"
    (case / "constant/polyMesh").mkdir(parents=True)
    for name in ("points", "faces", "owner", "neighbour", "boundary"):
        (case / "constant/polyMesh" / name).touch()
    named = tmp_path / "a.msh"
    assert find_meshes([tmp_path, named]) == [tmp_path / "a.msh", tmp_path / "b/cube.vtu", case]
    (tmp_path / "empty").mkdir()
    with pytest.raises(FileError, match="no mesh is in this folder"):
        find_meshes([tmp_path / "empty"])


def test_pieces_of_a_file_are_no_meshes_of_their_own(tmp_path):
    io.write(tmp_path / "whole.pvtu", gallery.make("cube", size=8))
    io.write(tmp_path / "whole" / "other.vtu", gallery.make("cube", size=8))
    (tmp_path / "torn.pvtu").write_text("<VTKFile")
    names = [str(path.relative_to(tmp_path)) for path in find_meshes([tmp_path])]
    assert names == ["torn.pvtu", "whole/other.vtu", "whole.pvtu"]
    assert find_meshes([tmp_path / "whole" / "whole_0.vtu"]) == [tmp_path / "whole" / "whole_0.vtu"]
