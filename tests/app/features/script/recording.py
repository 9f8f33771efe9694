"""Actions that a script records, and the check that it repeats them."""

import os
import subprocess
import sys

import numpy as np

from benchmarks.window.windows import save_and_wait
from hexmend import io
from hexmend.run import StoppingCriteria
from hexmend.run.recipe import Recipe, Stage
from hexmend.smoothers import METHODS
from hexmend_app.state.run.run_controller import Phase
from tests.patience import PATIENCE

SHORT = StoppingCriteria(max_iterations=6, tolerance=0)
ENDLESS = StoppingCriteria(max_iterations=100_000, tolerance=0)


def stage(method, stop=SHORT, **values):
    return Stage(METHODS[method](**values), stop)


def opened(qtbot, session, path):
    with qtbot.waitSignal(session.opener.ended, timeout=PATIENCE):
        session.commands.open(path)


def run(qtbot, session, what):
    with qtbot.waitSignal(session.run.ended, timeout=PATIENCE):
        if isinstance(what, Recipe):
            session.commands.run_recipe(what)
        else:
            session.commands.run(what)


def paused(qtbot, session, what, iterations):
    session.commands.step(what, iterations)
    held = session.run
    qtbot.waitUntil(lambda: held.phase is Phase.PAUSED and held.record.newest >= iterations, timeout=PATIENCE)


def stop(qtbot, session):
    with qtbot.waitSignal(session.run.ended, timeout=PATIENCE):
        session.run.stop()


def same_again(session, tmp_path):
    """Save the mesh, run the script, and compare the files; return the script."""
    out, script = tmp_path / "out.vtu", tmp_path / "script.py"
    save_and_wait(session, out)
    before = io.read(out)
    out.unlink()
    session.script.write(script)
    env = os.environ | {"PYTHONWARNINGS": "error"}
    done = subprocess.run([sys.executable, script], capture_output=True, text=True, env=env, cwd=tmp_path)
    assert done.returncode == 0, f"{done.stderr}\n{session.script.text}"
    assert done.stdout == ""
    after = io.read(out)
    assert np.array_equal(before.points, after.points), session.script.text
    assert np.array_equal(before.hexes, after.hexes)
    assert np.array_equal(before.pinned, after.pinned)
    assert {k: v.tolist() for k, v in before.hex_sets.items()} == {k: v.tolist() for k, v in after.hex_sets.items()}
    return session.script.text
