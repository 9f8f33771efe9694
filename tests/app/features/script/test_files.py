"""The script writes the same files as the window."""

import csv
import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image, ImageSequence

from benchmarks.window.windows import save_and_wait
from hexmend import io
from hexmend.mesh.rules import MotionRules
from hexmend.run import StoppingCriteria
from hexmend.run.recipe import Recipe, Stage
from hexmend.smoothers import METHODS
from hexmend_app.features.film.film_dialog import FilmChoice
from hexmend_app.picture.appearance import Arrows, Since, Traces
from hexmend_app.state.mesh.history import RecordedIteration
from hexmend_app.state.run.run_controller import Phase
from tests.app.driving import choose, open_and_wait, phase
from tests.patience import PATIENCE

pytestmark = pytest.mark.slow

SHORT = StoppingCriteria(max_iterations=4, tolerance=0)

#: Columns that are other figures each time.
CLOCKS = ("seconds", "setup_seconds", "message")


@pytest.fixture(autouse=True)
def script(window):
    """Clear the script, because tests share the window."""
    script = window.features["script"].script
    script.restart()
    return script


def run(window, qtbot, method="local-sd", stop=SHORT, **values):
    choose(window, method, stop, **values)
    window.session.commands.run(Stage(METHODS[method](**values), stop))
    qtbot.waitUntil(phase(window, Phase.FINISHED), timeout=PATIENCE)
    window.refresh()


def compared(window, qtbot, *methods, rules=None):
    comparison = window.session.comparison
    comparison.start([METHODS[name]() for name in methods], SHORT, rules)
    qtbot.waitUntil(lambda: not comparison.busy, timeout=PATIENCE)
    window.refresh()


def at(window, number):
    """Show an iteration of the newest run."""
    timeline = window.session.timeline
    timeline.go(timeline.record, number)
    window.refresh()


def again(script, folder, *paths):
    """Return the contents of files before and after the script has run."""
    before = [content(path) for path in paths]
    for path in paths:
        path.unlink()
    program = folder / "script.py"
    script.write(program)
    env = os.environ | {"PYTHONWARNINGS": "error"}
    done = subprocess.run([sys.executable, program], capture_output=True, text=True, env=env, cwd=folder)
    assert done.returncode == 0, f"{done.stderr}\n{script.text}"
    assert done.stdout == ""
    return list(zip(before, map(content, paths), strict=True))


def content(path: Path):
    """Return the bytes of a file, or the rows of a table without times."""
    if path.suffix != ".csv":
        return path.read_bytes()
    rows = list(csv.DictReader(path.read_text().splitlines()))
    return [{key: value for key, value in row.items() if not key.startswith(CLOCKS) and key != "step_seconds"}
            for row in rows]  # fmt: skip


def frames(data, folder):
    """Return the pictures in the bytes of a file, (frames, h, w, 3)."""
    path = folder / "frames"
    path.write_bytes(data)
    with Image.open(path) as image:
        return np.array([np.asarray(one.convert("RGB")) for one in ImageSequence.Iterator(image)], int)


def assert_same_pictures(both, folder):
    before, after = (frames(one, folder) for one in both)
    assert before.shape == after.shape
    assert before.std() > 5
    assert abs(before - after).mean() < 0.1


def test_a_histogram_with_snapshots(window, qtbot, script, tmp_path):
    run(window, qtbot)
    panel, feature = window.features["histogram"].panel, window.features["histogram"]
    at(window, 2)
    panel.keep_requested.emit()
    at(window, 4)
    window.session.view.colour_by("scaled-jacobian")
    panel.head.bins.setValue(23)
    window.refresh()
    paths = [tmp_path / f"quality{suffix}" for suffix in (".csv", ".png", ".svg")]
    assert all(map(feature.save, paths))
    assert len(content(paths[0])) == 1 + 23
    assert list(content(paths[0])[0])[2:] == ["at the start", "now", "Local steepest descent 2"]
    for before, after in again(script, tmp_path, *paths):
        assert before == after


def test_charts_of_a_run_and_its_branch(window, qtbot, script, tmp_path):
    run(window, qtbot)
    at(window, 2)
    window.session.commands.branch(Stage(METHODS["laplacian"](), SHORT))
    qtbot.waitUntil(lambda: not window.session.run.busy, timeout=PATIENCE)
    window.show_panel("convergence")
    window.refresh()
    paths = [tmp_path / f"runs{suffix}" for suffix in (".csv", ".png")]
    assert all(map(window.features["convergence"].save, paths))
    (rows, rows_again), (figure, figure_again) = again(script, tmp_path, *paths)
    assert rows == rows_again
    assert {row["branch_of"] for row in rows} == {"", "Local steepest descent 2"}
    assert figure == figure_again


def test_the_worst_hexes_a_recipe_and_a_scene(window, script, tmp_path):
    window.session.commands.pin(np.arange(30), True)
    window.session.recipe_draft.load(Recipe.of(Stage(METHODS["laplacian"](), SHORT), Stage(METHODS["mend"]())))
    window.refresh()
    paths = [tmp_path / name for name in ("worst.csv", "recipe.toml", "scene.toml")]
    assert window.features["hex_inspector"].save(paths[0])
    window.features["recipe"].save(paths[1])
    dialog = window.features["save"].picture_dialog()
    dialog.save_scene(str(paths[2]))
    dialog.close()
    for before, after in again(script, tmp_path, *paths):
        assert before == after


def test_the_visible_hexes(window, qtbot, script, tmp_path):
    window.session.view.dig(3)
    window.refresh()
    with qtbot.waitSignal(window.session.user_event, timeout=PATIENCE):
        window.features["save"].visible.save(tmp_path / "visible.vtu", window.canvas.viewport)
    ((mesh, mesh_again),) = again(script, tmp_path, tmp_path / "visible.vtu")
    assert mesh == mesh_again
    assert io.read(tmp_path / "visible.vtu").n_hexes == window.session.document.now.mesh.n_hexes - 1


def test_a_comparison_table_and_an_adopted_result(window, qtbot, script, tmp_path):
    compared(window, qtbot, "laplacian", "getme")
    window.session.commands.adopt_positions("GETMe", window.session.comparison.of("getme").state)
    save_and_wait(window.session, tmp_path / "out.vtu")
    assert window.features["compare"].save(tmp_path / "table.csv")
    (mesh, mesh_again), (rows, rows_again) = again(script, tmp_path, tmp_path / "out.vtu", tmp_path / "table.csv")
    assert mesh == mesh_again
    assert rows == rows_again
    assert [row["method"] for row in rows] == ["initial", "laplacian", "getme"]
    assert script.text.count("hx.compare(") == 1


def test_a_comparison_with_rules_of_motion_is_repeated_with_them(window, qtbot, script, tmp_path):
    free = np.flatnonzero(window.session.document.now.mesh.free)[:3]
    mesh = window.session.document.now.mesh.replace(node_sets={"bolt": free})
    io.write(tmp_path / "sets.vtu", mesh)
    open_and_wait(qtbot, window, tmp_path / "sets.vtu")
    script.restart()
    compared(window, qtbot, "laplacian", rules=MotionRules(fix=("bolt",)))
    window.session.commands.adopt_positions("Laplacian", window.session.comparison.of("laplacian").state)
    save_and_wait(window.session, tmp_path / "out.vtu")
    ((after, after_again),) = again(script, tmp_path, tmp_path / "out.vtu")
    assert after == after_again
    assert np.array_equal(io.read(tmp_path / "out.vtu").points[free], mesh.points[free])


def test_a_cancelled_comparison_ends_at_the_same_iterations(window, qtbot, script, tmp_path):
    comparison = window.session.comparison
    comparison.start([METHODS["laplacian"](), METHODS["local-sd"](), METHODS["getme"]()], StoppingCriteria(10**6, 0.0))
    qtbot.waitUntil(lambda: comparison.progress.iteration > 2, timeout=PATIENCE)
    comparison.cancel()
    qtbot.waitUntil(lambda: not comparison.busy, timeout=PATIENCE)
    assert window.features["compare"].save(tmp_path / "table.csv")
    ((rows, rows_again),) = again(script, tmp_path, tmp_path / "table.csv")
    assert [row["q_mean"] for row in rows] == [row["q_mean"] for row in rows_again]
    assert len(rows) == 2


@pytest.mark.parametrize("view", ["plain", "beside", "wipe", "movement", "cut"])
def test_a_picture_of_the_view(window, qtbot, script, tmp_path, view):
    session = window.session
    if view == "cut":
        window.action("cut").trigger()
        window.refresh()
    run(window, qtbot)
    if view in ("beside", "wipe"):
        session.side_views.show("as it was", session.document.start)
        at(window, 2)
        session.side_views.show("between", session.document.now)
        session.side_views.set_wiping(view == "wipe")
    if view == "movement":
        session.view.colour_by("moved-most")
        session.view.change(movement=Traces(Since.RUN, Arrows.ALL, 2.0))
    at(window, 4)
    path = tmp_path / "view.png"
    assert window.features["save"].picture(path, (400, 300))
    (both,) = again(script, tmp_path, path)
    assert_same_pictures(both, tmp_path)


def test_the_meshes_of_an_opened_picture(window, qtbot, script, tmp_path):
    session = window.session
    save_and_wait(session, tmp_path / "before.vtu")
    run(window, qtbot)
    save_and_wait(session, tmp_path / "after.vtu")
    words = ["render", "before.vtu", "after.vtu", "-o", "both.png"]
    subprocess.run([sys.executable, "-m", "hexmend", *words], check=True, cwd=tmp_path)
    open_and_wait(qtbot, window, tmp_path / "both.png")
    script.restart()
    window.refresh()
    assert len(session.side_views.all) == 1
    path = tmp_path / "again.png"
    assert window.features["save"].picture(path, (400, 300))
    (both,) = again(script, tmp_path, path)
    assert_same_pictures(both, tmp_path)
    assert "save it under this name first" not in script.text


@pytest.mark.parametrize("suffix", [".gif", ".png"])
def test_a_film_with_displacements(window, qtbot, script, tmp_path, suffix):
    run(window, qtbot)
    window.session.view.colour_by("q-change")
    window.session.view.change(movement=Traces(Since.ITERATION, Arrows.ALL, 2.0))
    window.canvas.look_along("+x")
    window.refresh()
    path, feature = tmp_path / f"run{suffix}", window.features["film"]
    feature.film(path, FilmChoice(width=320, rate=5, frames=3, histogram=True))
    qtbot.waitUntil(lambda: not feature.going_on, timeout=PATIENCE)
    (both,) = again(script, tmp_path, path)
    assert_same_pictures(both, tmp_path)
    assert len(frames(both[0], tmp_path)) == 3


def test_a_figure_set(window, qtbot, script, tmp_path):
    run(window, qtbot)
    compared(window, qtbot, "laplacian")
    feature, folder = window.features["figures"], tmp_path / "set"
    feature.write(folder)
    qtbot.waitUntil(lambda: not feature.going_on, timeout=PATIENCE)
    names = "surface.png", "cut.png", "distributions.svg", "convergence.svg", "table.csv", "captions.md", "commands.sh"
    surface, cut, *others = again(script, tmp_path, *(folder / name for name in names))
    for both in (surface, cut):
        assert_same_pictures(both, tmp_path)
    for before, after in others:
        assert before == after


def test_a_report(window, qtbot, script, tmp_path):
    run(window, qtbot)
    compared(window, qtbot, "laplacian")
    feature, path = window.features["figures"], tmp_path / "report.html"
    feature.write_report(path)
    qtbot.waitUntil(lambda: not feature.going_on, timeout=PATIENCE)
    ((before, after),) = again(script, tmp_path, path)
    assert before.count(b"<figure") == after.count(b"<figure") > 4
    qualities = re.compile(rb"[^<>:]{1,60}: [0-9,]+ inverted, q min [0-9.]+")  # the mesh in the page is one long text
    assert qualities.findall(before) == qualities.findall(after) != []


def test_runs_and_snapshots_are_read_from_the_session(window, qtbot, script, tmp_path):
    session = window.session
    run(window, qtbot)
    at(window, 2)
    window.features["histogram"].panel.keep_requested.emit()
    compared(window, qtbot, "laplacian")
    kept = tmp_path / "kept.hexmend"
    save_and_wait(session, kept)
    open_and_wait(qtbot, window, kept)
    script.restart()
    (record,) = session.history.records
    session.timeline.go(record, 3)
    window.refresh()
    assert session.history.iteration_of(session.document.now) == RecordedIteration(record, 3)
    save_and_wait(session, tmp_path / "third.vtu")
    paths = [tmp_path / name for name in ("third.vtu", "quality.csv", "runs.csv", "table.csv", "run.gif")]
    assert window.features["histogram"].save(paths[1])
    assert window.features["convergence"].save(paths[2])
    assert window.features["compare"].save(paths[3])
    film = window.features["film"]
    film.film(paths[4], FilmChoice(width=320, frames=3))
    qtbot.waitUntil(lambda: not film.going_on, timeout=PATIENCE)
    *others, pictures = again(script, tmp_path, *paths)
    for before, after in others:
        assert before == after
    assert_same_pictures(pictures, tmp_path)
    assert "save it under this name first" not in script.text
