"""The script records all actions that change the mesh or the view, or write files."""

from fnmatch import fnmatch

import numpy as np
import pytest
from PySide6.QtWidgets import QFileDialog

from hexmend import io
from hexmend.gallery import make
from hexmend.mesh.mesh import Mesh
from hexmend.run import StoppingCriteria
from hexmend.run.recipe import Recipe, Stage
from hexmend.smoothers import METHODS
from hexmend_app.features.film.film_dialog import FilmDialog
from hexmend_app.features.pad.pad_dialog import PadDialog
from hexmend_app.features.save.picture_dialog import PictureDialog
from hexmend_app.state.run.run_controller import Phase
from tests.app.driving import choose, phase
from tests.patience import PATIENCE

ENDLESS = StoppingCriteria(max_iterations=100_000, tolerance=0)

#: What needs no line: it neither changes the mesh, nor writes a file of it, nor changes what a scene holds.
UNTOLD = {
    "panel_*": "lays out the window",
    "panels": "lays out the window",
    "reset_layout": "lays out the window",
    "drawer": "lays out the window",
    "theme_*": "is the window's own",
    "about": "helps",
    "keys": "helps",
    "commands": "finds other actions",
    "quit": "ends the window",
    "script": "writes the script",
    "copy_camera": "copies",
    "copy_measurement": "copies",
    "measure": "begins to pick points, which are told",
    "copy_command": "copies",
    "pace_*": "is how runs are watched, which changes no result",
    "key_figures": "lays out the view",
    "colour_by_material": "needs a mesh of several materials",
    "mark_curve": "is tested with curves",
    "unmark_*": "is tested with curves",
    "slide_on_*": "is tested with target surfaces",
    "show_target": "is tested with target surfaces",
    "show_curved": "is tested with hexes of second order",
    "cameras": "shows a dialog, from which a camera is looked through",
    "console": "shows a panel",
    "pyvista_window": "shows a window of PyVista",
    "doctor": "shows a panel",
    "why": "shows a panel",
    "explain_node": "shows a panel, and in the view what no scene holds",
    "recipe_load": "is told as the recipe runs",
    "recover": "asks; what is opened then is told as a session is",
}

#: Actions in the order in which each can be done after those before it, by what has to be prepared.
TOLD = {
    "look": ("edges", "shading", "neutral", "cut", "face", "roll_left", "roll_right", "view_x", "view_y", "view_z",
             "view_minus_x", "view_minus_y", "view_minus_z", "view_iso", "view_back", "view_forward", "parallel", "up_x",
             "up_y", "up_z", "paste_camera", "fit", "keep_camera"),
    "structure": ("show_irregular", "show_boundary", "show_sharp", "show_fixed", "show_free", "show_locked",
                  "show_kinds", "show_others", "show_original", "show_interfaces"),
    "hexes": ("next_worst", "previous_worst", "free_isolated", "back", "isolate", "dig", "undig", "visit", "tag", "pin",
              "undo", "redo"),
    "views": ("beside", "wipe", "wipe_left", "wipe_right", "close_views", "compare", "cancel_comparison"),
    "runs": ("step", "iteration_first", "iteration_on", "iteration_back", "iteration_newest", "stop",
             "iteration_play", "iteration_branch", "reset", "run", "recipe_run", "next_node", "ten_nodes",
             "finish_sweep"),
    "files": ("save", "save_visible", "screenshot", "save_session", "recipe_save", "figure_set", "report", "film",
               "open_demo", "open", "repair",
              "pad"),
}  # fmt: skip


def test_every_action_is_recorded_or_listed_as_exempt(window):
    told = [id for ids in TOLD.values() for id in ids]
    untold = {id for id in window.window_actions if any(fnmatch(id, one) for one in UNTOLD)}
    assert set(told) & untold == set()
    assert set(window.window_actions) == {*told, *untold}


@pytest.fixture
def others(window, qtbot, tmp_path, monkeypatch):
    """Prepare the actions that need it; files are written to a temporary folder."""
    session = window.session

    def target(parent, title, proposed, kinds, *chosen):
        return str(tmp_path / title.replace(" ", "-")), kinds.split(";;")[0]

    blocks = tmp_path / "blocks.vtu"
    write_turned(blocks)
    monkeypatch.setattr(QFileDialog, "getSaveFileName", target)
    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *asked: (str(blocks), ""))
    monkeypatch.setattr("hexmend_app.features.figures.feature.ask_figures", lambda *asked: str(tmp_path / "set"))
    monkeypatch.setattr("hexmend_app.features.camera.feature.ask_camera_name", lambda *asked: "mine")
    monkeypatch.setattr(FilmDialog, "exec", lambda dialog: True)
    monkeypatch.setattr(PadDialog, "exec", lambda dialog: True)
    monkeypatch.setattr(
        PictureDialog, "exec", lambda dialog: dialog.target.line.setText(str(tmp_path / "view.png")) or True
    )

    def chosen(h):
        session.view.end_isolation()
        session.selection.choose(h, int(session.document.now.mesh.hexes[h][0]))

    def idle():
        qtbot.waitUntil(lambda: not session.run.busy, timeout=PATIENCE)

    def paused():
        session.commands.step(Stage(METHODS["local-sd"](), ENDLESS), 3)
        qtbot.waitUntil(phase(window, Phase.PAUSED), timeout=PATIENCE)
        session.run.stop()
        idle()

    def short(method):
        idle()
        choose(window, method, StoppingCriteria(max_iterations=2, tolerance=0))
        session.recipe_draft.load(
            Recipe.of(Stage(METHODS["laplacian"](), StoppingCriteria(max_iterations=2, tolerance=0)))
        )

    return {
        "view_x": lambda: window.action("copy_camera").trigger(),
        "fit": lambda: window.canvas.fly_to(7),
        "isolate": lambda: chosen(5),
        "dig": lambda: chosen(6),
        "visit": lambda: chosen(7),
        "compare": lambda: choose(window, "local-sd", ENDLESS),
        "step": lambda: choose(window, "local-sd", ENDLESS),
        "iteration_play": lambda: session.timeline.go(session.timeline.record, 0),
        "iteration_branch": lambda: short("laplacian"),
        "reset": idle,
        "run": lambda: short("local-sd"),
        "recipe_run": idle,
        "next_node": idle,
        "recipe_save": lambda: short("laplacian"),
        "film": paused,
    }


def write_turned(path):
    """Return a mesh that the doctor can repair: two blocks, one of them inside out."""
    one = make("cube", size=27)
    places = np.vstack([one.points, one.points + [np.ptp(one.points[:, 0]), 0, 0]])
    turned = one.hexes[:, [4, 5, 6, 7, 0, 1, 2, 3]] + one.n_nodes
    io.write(path, Mesh(places, np.vstack([one.hexes, turned])))


def rest(window, qtbot):
    """Wait for all tasks except an active run."""
    session, features = window.session, window.features
    qtbot.waitUntil(
        lambda: (
            not (
                window.canvas.camera_animation.active
                or session.opener.busy
                or session.timeline.playing
                or session.run.phase in (Phase.PREPARING, Phase.RUNNING, Phase.STOPPING)
                or features["film"].going_on
                or features["save"].visible.going_on
                or features["figures"].going_on
            )
        ),
        timeout=PATIENCE,
    )
    window.refresh()


def can_be_done(window, action):
    window.refresh()
    return action.isEnabled()


@pytest.mark.slow
@pytest.mark.parametrize("group", TOLD)
def test_actions_appear_in_the_script(window, qtbot, others, group):
    script = window.features["script"].script
    for id in TOLD[group]:
        others.get(id, lambda: None)()
        rest(window, qtbot)
        before, action = script.text, window.window_actions[id]
        if group == "structure":  # whatever there is in the mesh
            name = id.removeprefix("show_")
            declared = next(one for one in window.menus.declared() if one.id == id)
            declared.handle(not window.session.view.look.structure.is_on(name))
        else:
            qtbot.waitUntil(lambda action=action: can_be_done(window, action), timeout=PATIENCE)
            action.trigger()
        window.refresh()
        try:
            qtbot.waitUntil(lambda before=before: script.text != before, timeout=PATIENCE)
        except Exception:
            pytest.fail(f"{id} is not told")
        rest(window, qtbot)
