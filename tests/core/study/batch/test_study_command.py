"""`hexmend study RECIPE.toml MESH...`: one table of all tasks, failed ones included; no task is run twice."""

import csv
import json
import os
import signal

import pytest

from hexmend import io
from hexmend.cli.main import main
from hexmend.study.batch.task import COLUMNS
from tests.core.study.batch.conftest import is_running, wait_until

pytestmark = pytest.mark.slow

DEEDS = '[[method]]\nmethod = "trial"\nparameters = { does = ["rest", "raise", "crash"] }'
WAITS = '[[method]]\nmethod = "trial"\nparameters = { does = "wait", number = [1, 2, 3, 4, 5, 6] }'


def rows_of(laboratory):
    with open(laboratory.out / "study.csv", newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def test_a_failed_task_is_a_row_with_its_reason_and_the_others_are_run(laboratory):
    mesh, torn = laboratory.mesh(), laboratory.folder / "torn.vtk"
    torn.write_bytes(mesh.read_bytes()[:200])
    words = laboratory.recipe(f'title = "Deeds"\n{DEEDS}'), mesh, torn, laboratory.folder / "none.vtk"
    done = laboratory.run(*words)
    assert done.returncode == 3
    assert "9 tasks: 9 done now, 0 done before, 8 without a result." in done.stdout
    said = "none.vtk, all 3: unreadable: none.vtk: there is no such file"
    assert said in done.stderr
    rows = rows_of(laboratory)
    assert [row["status"] for row in rows] == ["done", "failed", "lost", *["unreadable"] * 6]
    assert all(row["reason"] for row in rows[1:])
    assert [(row["mesh"], row["case"]) for row in rows[:2]] == [
        (str(mesh), "trial does=rest"),
        (str(mesh), "trial does=raise"),
    ]
    page = (laboratory.out / "study.md").read_text(encoding="utf-8")
    assert "| trial does=rest | 1 of 3 | 1 | 0 of 0 | 0 | +0.0000 | +0.0000 |" in page
    assert "| trial does=crash | 0 of 3 |" in page
    assert "| cube.vtk | trial does=raise | failed | ValueError: it does not like this mesh |" in page
    assert r"\begin{tabular}" in (laboratory.out / "study.tex").read_text(encoding="utf-8")


def test_both_tables_hold_the_same(laboratory):
    parquet = pytest.importorskip("pyarrow.parquet")
    laboratory.run(laboratory.recipe(f'methods = ["laplacian", "mend"]\n{DEEDS}'), laboratory.mesh())
    table = parquet.read_table(laboratory.out / "study.parquet")
    assert {field.name: str(field.type) for field in table.schema} == {
        name: {str: "string", int: "int64", float: "double"}[type_] for name, type_ in COLUMNS.items()
    }
    words = [{key: "" if value is None else str(value) for key, value in row.items()} for row in table.to_pylist()]
    assert words == rows_of(laboratory)
    assert [row["method"] for row in words] == ["laplacian", "mend", "trial", "trial", "trial"]
    assert " p=auto " in words[1]["parameters"]


def test_without_pyarrow_only_the_csv_is_written_and_a_line_says_so(laboratory):
    (laboratory.folder / "site/pyarrow.py").write_text("raise ImportError")
    done = laboratory.run(laboratory.recipe('methods = ["laplacian"]'), laboratory.mesh())
    assert done.returncode == 0
    remedy = "run  pip install '.[study]'  in the source folder of Hexmend"
    assert done.stderr == f"hexmend: study.parquet needs pyarrow: {remedy}\n"
    assert len(rows_of(laboratory)) == 1
    assert not (laboratory.out / "study.parquet").exists()


def test_finished_tasks_are_run_again_only_on_request(laboratory):
    words = laboratory.recipe(DEEDS), laboratory.mesh()
    laboratory.run(*words)
    first = rows_of(laboratory)
    done = laboratory.run(*words)
    assert "3 tasks: 1 done now, 2 done before" in done.stdout  # whose process crashed is tried again
    assert len(laboratory.said("began")) == 4
    assert rows_of(laboratory)[:2] == first[:2]
    laboratory.mesh(seed=5)
    laboratory.run(*words, "--again")
    assert len(laboratory.said("began")) == 7


def test_files_of_the_same_content_are_one_task(laboratory):
    recipe = laboratory.recipe('[[method]]\nmethod = "trial"')
    laboratory.run(recipe, laboratory.mesh("a.vtk"), laboratory.mesh("b.vtk"), laboratory.mesh("a.vtk"))
    assert len(laboratory.said("began")) == 1
    a, b = rows_of(laboratory)
    assert (a["key"], a["mesh"][-5:], b["mesh"][-5:]) == (b["key"], "a.vtk", "b.vtk")


def test_meshes_are_written_and_missing_ones_are_made_again(laboratory):
    words = laboratory.recipe('methods = ["laplacian"]\n[[method]]\nmethod = "trial"'), laboratory.mesh()
    for expected in (["cube-laplacian", "cube-trial"], ["cube-laplacian"]):
        laboratory.run(*words, "--write-meshes")
        assert [row["output"].rpartition("/")[2][:-13] for row in rows_of(laboratory)] == [
            "cube-laplacian",
            "cube-trial",
        ]
        for path in (laboratory.out / "meshes").iterdir():
            assert io.read(path).n_hexes == 8
            if expected[1:] and "trial" in path.name:
                path.unlink()
    assert len(laboratory.said("began")) == 2


def test_a_killed_study_continues_with_the_remaining_tasks(laboratory):
    """Of six tasks two are done, two at work and two to come when it is killed: then four are done."""
    recipe = laboratory.recipe(
        '[[method]]\nmethod = "trial"\nparameters = { number = [1, 2] }\n'
        '[[method]]\nmethod = "trial"\ntitle = "waits"\nparameters = { does = "wait", number = [3, 4, 5, 6] }'
    )
    words = recipe, laboratory.mesh(), "--jobs", "2"
    with laboratory.started(*words) as study:
        wait_until(
            lambda: len(laboratory.said("began")) == 4 and len(laboratory.answers) == 2,
            "two are done, two begin",
            study,
        )
        study.send_signal(signal.SIGKILL)
        study.wait()
        at_work = [process for number, process in laboratory.said("began") if number > 2]
        wait_until(lambda: not any(map(is_running, at_work)), "the tasks' processes end with the study")
    assert set(laboratory.answers) == {1, 2}
    assert not (laboratory.out / "study.csv").exists()
    done = laboratory.run(*words)
    assert done.returncode == 0
    assert "6 tasks: 4 done now, 2 done before, 0 without a result." in done.stdout
    assert sorted(number for number, _ in laboratory.said("began")) == [1, 2, 3, 3, 4, 4, 5, 6]
    assert sorted(number for number, _ in laboratory.said("did")) == [1, 2, 3, 4, 5, 6]
    assert len(rows_of(laboratory)) == 6


def test_an_interrupted_study_writes_the_finished_tasks(laboratory):
    recipe = laboratory.recipe(f'[[method]]\nmethod = "trial"\ntitle = "rests"\n{WAITS}')
    with laboratory.started(recipe, laboratory.mesh(), "--jobs", "1") as study:
        wait_until(lambda: len(laboratory.said("began")) == 2, "the second task begins", study)
        study.send_signal(signal.SIGINT)
        _, said = study.communicate()
        assert study.returncode == 128 + signal.SIGINT
    assert "Interrupted: finished tasks are kept; run the same command again to continue." in said
    assert "Traceback" not in said
    assert [row["case"] for row in rows_of(laboratory)] == ["rests"]
    assert "1 of 7 tasks are done." in (laboratory.out / "study.md").read_text(encoding="utf-8")
    assert not any(is_running(process) for _, process in laboratory.said("began"))


@pytest.mark.parametrize(("words", "status", "said"), [
    (["recipe.toml"], 2, "no mesh is named"),
    (["thesys", "cube.vtk"], 2, "'thesys' is not a study"),
    (["recipe.toml", "cube.vtk", "--jobs", "0"], 2, "--jobs 0 is too small"),
    (["recipe.toml", "cube.vtk", "--jobs", "2", "--scheduler", "tcp://none:1"], 2, "leave out one of them"),
    (["none.toml", "cube.vtk"], 3, "none.toml: there is no such file"),
    (["recipe.toml", "cube.vtk", "-o", "cube.vtk"], 3, "cube.vtk: is a file"),
])  # fmt: skip
def test_wrong_usage_is_one_line_before_the_work(laboratory, monkeypatch, complaint, words, status, said):
    laboratory.mesh()
    laboratory.recipe('methods = ["laplacian"]')
    monkeypatch.chdir(laboratory.folder)
    assert said in complaint("study", *words, status=status)
    assert not (laboratory.folder / "recipe").exists()


def test_the_folder_is_called_after_the_recipe(laboratory, monkeypatch, capsys):
    laboratory.mesh()
    laboratory.recipe('methods = ["laplacian"]')
    monkeypatch.chdir(laboratory.folder)
    assert main(["study", "recipe.toml", "cube.vtk"]) == 0
    (task,) = os.listdir("recipe/tasks")
    assert json.loads((laboratory.folder / "recipe/tasks" / task).read_text())["answer"]["status"] == "done"
    assert "1 tasks: 1 done now" in capsys.readouterr().out


def test_a_folder_stands_for_its_meshes(laboratory, monkeypatch, run_command):
    (laboratory.folder / "meshes/fine").mkdir(parents=True)
    for name in ("meshes/a.vtk", "meshes/fine/b.vtk"):
        laboratory.mesh(name, seed=len(name))
    (laboratory.folder / "meshes/notes.txt").write_text("not a mesh")
    (laboratory.folder / "empty").mkdir()
    laboratory.recipe('methods = ["laplacian"]')
    monkeypatch.chdir(laboratory.folder)
    assert "2 tasks: 2 done now" in run_command("study", "recipe.toml", "meshes").out
    assert "no mesh is in this folder" in run_command("study", "recipe.toml", "empty", status=3).err
