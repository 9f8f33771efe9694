"""Sessions: saved from the window and opened again, the same picture, the same tables, the same moment."""

from __future__ import annotations

import numpy as np

from hexmend.recipe import Stage
from hexmend.run import Stop
from hexmend.run.breakpoints import Breakpoints
from hexmend.smoothers import METHODS
from hexmend_app.state.clip import PlaneClip
from hexmend_app.state.look import Arrows, ColourScale, Structure, Traces, ValueRange
from tests.app.driving import open_and_wait, pixels
from tests.patience import PATIENCE


def run(window, qtbot, method, iterations=4):
    with qtbot.waitSignal(window.session.smoothing.ended, timeout=PATIENCE):
        window.session.commands.run(Stage(METHODS[method](), Stop(max_iterations=iterations, tolerance=0)))
    window.refresh()


def work(window, qtbot):
    """Do some of everything that a session keeps."""
    session = window.session
    run(window, qtbot, "laplacian")
    session.commands.tag("bad corner", [3, 5, 8])
    session.commands.pin(17, True)
    run(window, qtbot, "local-sd", 3)
    session.kept.keep("a kept moment", session.document.now)
    with qtbot.waitSignal(session.comparison.changed, timeout=PATIENCE):
        session.comparison.start([METHODS["laplacian"](), METHODS["getme"]()], Stop(max_iterations=2))
    qtbot.waitUntil(lambda: not session.comparison.busy, timeout=PATIENCE)
    session.timeline.go(session.history.records[0], 2)
    session.order.choose(Stage(METHODS["getme"](relaxation=0.6), Stop(max_iterations=77)), "a reason")
    session.chain.add(Stage(METHODS["laplacian"](), Stop(max_iterations=5)))
    session.chain.rename("two of them")
    window.features["smooth"].panel.breakpoint_form.set_breakpoints(Breakpoints(inverts=True, node=12, move=0.25))
    session.view.change(
        clip=PlaneClip.at((1, 0, 0.2), session.document.now.mesh.points.mean(axis=0)),
        scale=ColourScale("scaled-jacobian", "plasma"),
        quality_range=ValueRange("scaled-jacobian", -1.0, 0.9, inverted=True),
        dug=frozenset({40, 41}),
        structure=Structure(sharp=True, fixed=True),
        traces=Traces(arrows=Arrows.SIGHT, factor=2.0),
    )
    session.selection.choose(9, int(session.document.now.mesh.hexes[9, 3]))
    window.refresh()
    window.canvas.look_along("-x")
    window.canvas.roll(20)


def seen(window, qtbot):
    """The picture of the view when all that is looked for is found and nothing moves."""
    session = window.session
    window.refresh()
    qtbot.waitUntil(lambda: session.finder.structure is not None and not session.classer.busy, timeout=PATIENCE)
    window.refresh()
    window.canvas.draw_still()
    pixels(window)
    body, lighting = window.canvas.viewport.body, window.canvas.lighting
    qtbot.waitUntil(lambda: body.light is not None and not lighting.under_way, timeout=PATIENCE)
    return pixels(window)


def tables(window):
    """What tables and charts are made from."""
    session = window.session
    history = session.history
    moment = session.timeline.moment
    return {
        "summary": session.document.now.summary,
        "start": session.document.start.summary,
        "undo": session.document.undo_title,
        "redo": session.document.redo_title,
        "runs": [(r.name, r.title, r.rows, r.result, r.message, r.pauses) for r in history.records],
        "advice": [
            (r.advice.why, [(one.title, one.smoother, one.stop) for one in r.advice.suggestions])
            for r in history.records
        ],
        "parents": [(r.parent.record.name, r.parent.number) if r.parent else None for r in history.records],
        "kept iterations": [history.kept(r).tolist() for r in history.records],
        "gone through": session.timeline.record.name,
        "moment": (moment.record.name, moment.number),
        "compared": [(one.row.method, one.row.message, one.row.after) for one in session.comparison.results],
        "look": session.view.look,
        "kept": [(one.slot, one.name) for one in session.kept.all],
        "chosen": (session.selection.hex, session.selection.node),
        "order": (session.order.stage, session.order.why),
        "chain": session.chain.given(),
        "breakpoints": session.smoothing.breakpoints,
        "form": window.features["smooth"].panel.breakpoint_form.breakpoints(),
        "tags": {name: members.tolist() for name, members in session.document.now.mesh.hex_sets.items()},
        "pins": np.flatnonzero(session.document.now.mesh.pinned).tolist(),
    }


def test_a_session_is_as_it_was(window, qtbot, tmp_path, mesh_file):
    work(window, qtbot)
    path = tmp_path / "work.hexmend"
    session = window.session
    picture, before = seen(window, qtbot), tables(window)
    points = session.document.now.mesh.points
    positions = [[r.points(n) for n in session.history.kept(r)] for r in session.history.records]
    assert window.features["session"].save(path)
    open_and_wait(qtbot, window, mesh_file)
    window.refresh()
    assert not session.history.records
    open_and_wait(qtbot, window, path)
    np.testing.assert_array_equal(seen(window, qtbot), picture)
    assert tables(window) == before
    np.testing.assert_array_equal(session.document.now.mesh.points, points)
    for record, places in zip(session.history.records, positions, strict=True):
        for number, place in zip(session.history.kept(record), places, strict=True):
            np.testing.assert_array_equal(record.points(number), place)
