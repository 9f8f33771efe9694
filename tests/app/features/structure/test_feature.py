"""The structure of a mesh in the window: found beside it, counted in the panel, shown by mouse and keys."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel, QLineEdit

from hexmend import gallery, io
from hexmend.cells import Cells
from hexmend.mesh import Mesh
from hexmend.structure import structure
from hexmend.surface import Kind
from hexmend_app.features.structure.structure_panel import StructurePanel
from hexmend_app.scene.layers.structure import KINDS, LOCKED, PINNED, SHARP, VALENCES
from hexmend_app.shell.palette import CommandPalette
from hexmend_app.shell.program import application
from hexmend_app.state.classer import PIN
from hexmend_app.state.document import State
from hexmend_app.state.look import Look, Structure
from hexmend_app.state.task import running
from tests.app.driving import LEFT, choose, click, key, open_and_wait, tick, turn
from tests.app.driving import pixels as drawn
from tests.core.grids import grid
from tests.core.surface.solids import ball, slid
from tests.core.test_structure import tetrahedron
from tests.patience import PATIENCE

KEYS = {
    "irregular": "S",
    "boundary": "B",
    "sharp": "H",
    "fixed": "X",
    "free": "M",
    "locked": "L",
    "kinds": "J",
    "others": "G",
    "original": "O",
}


@pytest.fixture
def panel(qtbot):
    application()
    panel = StructurePanel()
    qtbot.addWidget(panel)
    panel.resize(330, panel.sizeHint().height())
    panel.show()
    qtbot.waitExposed(panel)
    return panel


@pytest.fixture
def five(window, qtbot, tmp_path):
    """The window with a mesh of five blocks in it."""
    io.write(tmp_path / "five.vtu", gallery.make("five-side", size=500))
    open_and_know(qtbot, window, tmp_path / "five.vtu")
    window.session.view.change(shading=False)  # shades come when the view has rested, whenever that is
    window.refresh()
    return window


def open_and_know(qtbot, window, path):
    """Open a mesh, and wait until its structure is found: not that of the mesh before."""
    open_and_wait(qtbot, window, path)
    qtbot.waitUntil(lambda: window.session.finder.structure is not None, timeout=PATIENCE)
    window.refresh()


def press_key(window, name):
    """Press the key of a layer."""
    key(window, getattr(Qt.Key, f"Key_{KEYS[name]}"))


def press(box):
    QTest.mouseClick(box, LEFT, pos=QPoint(8, box.height() // 2))


def texts(panel, name):
    """What stands beside a layer."""
    turn()  # what stood there before goes
    return [label.text() for label in panel.layers[name].entries.findChildren(QLabel)]


def pixels(window):
    """A fast frame: a fine one has other edges."""
    window.refresh()
    window.canvas.viewport.moving()
    return drawn(window)


def count(image, colour):
    return int((image == np.frombuffer(bytes.fromhex(colour[1:]), np.uint8)).all(axis=2).sum())


# The panel


def test_before_the_edges_are_found_they_cannot_be_chosen_and_nodes_can(panel):
    assert texts(panel, "irregular") == []
    panel.set_found(None)
    panel.set_classes(None)
    panel.set_nodes(8, 1, 3, 2)
    assert [name for name, on in panel.offered().items() if on] == ["fixed", "free", "locked", "kinds", "original"]
    assert texts(panel, "irregular") == ["counting…"]
    assert "Being counted" in panel.layers["sharp"].box.toolTip()
    assert texts(panel, "fixed") == ["8 boundary", "1 pinned"]
    assert texts(panel, "locked") == ["of 2 hexes"]


def test_kinds_that_could_not_be_worked_out_are_not_said_to_be_counted(panel):
    panel.set_classes(None, ValueError("no boundary"))
    assert texts(panel, "kinds") == ["could not be worked out"]
    assert not panel.offered()["kinds"]
    assert "This could not be worked out: no boundary." in panel.layers["kinds"].box.toolTip()
    panel.set_classes(None)
    assert texts(panel, "kinds") == ["counting…"]
    assert panel.offered()["kinds"]


def test_edges_are_counted_by_valence(panel):
    panel.set_found(structure(tetrahedron()))
    assert texts(panel, "irregular") == ["4 of 3", "1 node"]
    assert "120° at three" in panel.layers["irregular"].box.toolTip()
    mesh = grid(8)
    p = mesh.points / 4 - 1
    size = np.maximum(np.linalg.norm(p, axis=1, keepdims=True), 1e-9)
    panel.set_found(structure(Mesh(p * np.abs(p).max(axis=1, keepdims=True) / size, mesh.hexes)))
    assert texts(panel, "boundary") == [f"{12 * 8} of 1"]


def test_no_count_is_cut_off_in_a_narrow_column(panel, qtbot):
    valence = np.repeat([3, 5, 6, 7], [14461, 10776, 1048, 313])
    panel.set_found(dataclasses.replace(structure(tetrahedron()), interior_valence=valence))
    panel.set_nodes(9156, 120, 28317, 44)
    panel.resize(280, 400)
    turn()
    for label in panel.findChildren(QLabel):
        if label.isVisible():
            assert label.width() >= label.fontMetrics().horizontalAdvance(label.text()), label.text()


def test_what_a_mesh_has_not_is_disabled_with_its_reason_but_can_be_switched_off(panel):
    panel.set_found(structure(grid(2)))
    panel.set_nodes(26, 0, 1, 0)
    assert panel.offered() == {
        "irregular": False, "boundary": False, "sharp": True, "fixed": True, "free": True, "locked": False,
        "kinds": False, "others": False, "original": True,
    }  # fmt: skip
    assert texts(panel, "irregular") == ["none"]
    assert "four hexes share every edge" in panel.layers["irregular"].box.toolTip()
    heard = []
    panel.structure_changed.connect(heard.append)
    press(panel.layers["irregular"].box)
    assert heard == []
    panel.set_structure(Structure(irregular=True))
    press(panel.layers["irregular"].box)
    assert heard == [Structure()]
    assert not panel.offered()["irregular"]


def test_a_click_chooses_one_layer_more(panel):
    panel.set_found(structure(grid(2)))
    heard = []
    panel.structure_changed.connect(heard.append)
    panel.set_structure(Structure(locked=True))
    press(panel.layers["sharp"].box)
    press(panel.layers["sharp"].box)
    assert heard == [Structure(sharp=True, locked=True), Structure(locked=True)]


# The window


@pytest.mark.parametrize("name", ["irregular", "sharp", "fixed", "free"])
def test_a_key_shows_and_hides_a_layer(five, name):
    before = pixels(five)
    box = five.features["structure"].panel.layers[name].box
    press_key(five, name)
    assert five.session.view.look.structure == Structure(**{name: True})
    assert box.isChecked()
    assert five.actions[f"show_{name}"].isChecked()
    if name != "free":  # of which none is in sight
        assert (np.abs(pixels(five) - before).sum(axis=2) > 60).sum() > 100
    press_key(five, name)
    assert five.session.view.look == Look(shading=False)
    np.testing.assert_array_equal(pixels(five), before)


def test_kinds_of_nodes_are_found_when_they_are_wanted_and_follow_the_feature_angle(five, qtbot):
    press_key(five, "kinds")
    qtbot.waitUntil(lambda: five.canvas.viewport.frame.look.structure.kinds, timeout=PATIENCE)
    panel = five.features["structure"].panel
    classes = five.session.classer.classes
    assert texts(panel, "kinds")[0] == f"{classes.count(Kind.CORNER)} corners"
    assert count(pixels(five), KINDS[Kind.PATCH]) > 100
    assert classes.count(Kind.CURVE)
    with qtbot.waitSignal(five.session.classer.found, timeout=PATIENCE):
        choose(five, "mend", feature_angle=180)
    five.refresh()
    assert five.session.classer.classes.count(Kind.CURVE) == 0
    assert not any("curves" in text for text in texts(panel, "kinds"))
    assert count(pixels(five), KINDS[Kind.CURVE]) == 0


def test_a_pin_makes_a_node_of_the_boundary_stay(five, qtbot):
    press_key(five, "kinds")
    qtbot.waitUntil(lambda: five.canvas.viewport.frame.look.structure.kinds, timeout=PATIENCE)
    node = int(np.flatnonzero(five.session.classer.classes.kinds == Kind.PATCH)[0])
    five.session.commands.pin(node, True)
    qtbot.waitUntil(lambda: five.session.classer.classes.kinds[node] == PIN, timeout=PATIENCE)
    five.session.commands.undo()
    qtbot.waitUntil(lambda: five.session.classer.classes.kinds[node] == Kind.PATCH, timeout=PATIENCE)


def test_locked_hexes_that_sliding_frees_are_counted(window, qtbot, tmp_path):
    io.write(tmp_path / "ball.vtu", slid(ball(3), 0.6, seed=0))
    open_and_wait(qtbot, window, tmp_path / "ball.vtu")
    window.show_panel("show")
    window.refresh()
    qtbot.waitUntil(lambda: window.session.classer.of(window.session.document.now.mesh) is not None, timeout=PATIENCE)
    window.refresh()
    classes = window.session.classer.classes
    said = texts(window.features["structure"].panel, "locked")
    assert said == [f"of {classes.locked} hexes", f"{classes.freed} freed by sliding"]


def test_the_original_surface_is_that_of_the_opened_mesh(five):
    press_key(five, "original")
    window, opened = five, five.session.document.start.mesh.points
    five.refresh()
    assert window.canvas.viewport.original.shown
    mesh = window.session.document.now.mesh
    moved = mesh.with_points(mesh.points * 1.2)
    window.session.commands.take("grow", State.of(moved))
    five.refresh()
    places = window.canvas.viewport.original.places
    np.testing.assert_allclose(np.ptp(places, axis=0), np.ptp(opened, axis=0), rtol=1e-6)
    press_key(five, "original")
    assert not window.canvas.viewport.original.shown


def test_a_mesh_without_them_offers_no_irregular_edges(five):
    assert not five.actions["show_boundary"].isEnabled()
    assert not five.actions["show_locked"].isEnabled()
    press_key(five, "boundary")
    assert five.session.view.look.structure == Structure()


def test_irregular_edges_are_found_by_name_and_seen(five, qtbot):
    five.actions["commands"].trigger()
    field = five.findChild(CommandPalette).findChild(QLineEdit)
    QTest.keyClicks(field, "irregular edges inside")
    QTest.keyClick(field, Qt.Key.Key_Return)
    qtbot.waitUntil(lambda: five.session.view.look.structure.irregular, timeout=2000)
    assert count(pixels(five), VALENCES[5]) > 100


def test_a_layer_stays_on_for_the_next_mesh_as_soon_as_its_edges_are_found(five, qtbot, tmp_path):
    press_key(five, "sharp")
    press_key(five, "irregular")
    io.write(tmp_path / "cube.vtu", grid(3))
    open_and_wait(qtbot, five, tmp_path / "cube.vtu")
    assert five.session.finder.structure is None
    assert not five.canvas.viewport.frame.look.structure.edges  # the view does not wait for them
    qtbot.waitUntil(lambda: five.session.finder.structure is not None, timeout=PATIENCE)
    five.refresh()
    assert five.canvas.viewport.frame.look.structure == Structure(irregular=True, sharp=True)
    assert texts(five.features["structure"].panel, "sharp") == ["36"]
    assert five.features["structure"].panel.layers["irregular"].box.isEnabled()  # to be switched off
    assert count(pixels(five), SHARP) > 300
    assert count(pixels(five), VALENCES[5]) == 0


def test_marks_follow_a_smoother(window, qtbot, tmp_path):
    io.write(tmp_path / "five.vtu", gallery.make("five-side", size=500, scramble=0.4, seed=2))
    open_and_know(qtbot, window, tmp_path / "five.vtu")
    tick(window.features["structure"].panel.layers["irregular"].box)
    marks = window.canvas.viewport.structure.irregular_inside
    before = np.array(marks.poly.points)
    start = window.session.document.now
    choose(window, "laplacian")
    click(window, "Step")
    qtbot.waitUntil(lambda: window.session.document.now is not start, timeout=PATIENCE)
    window.refresh()
    now = np.array(marks.poly.points)
    assert not np.array_equal(now, before)
    np.testing.assert_array_equal(now, window.session.document.now.mesh.points[marks.nodes])


def test_a_pinned_node_changes_its_colour(five, qtbot):
    tick(five.features["structure"].panel.layers["fixed"].box)
    inside = int(np.flatnonzero(five.session.document.now.mesh.free)[0])
    five.session.view.change(peel=1)
    five.refresh()
    assert count(pixels(five), PINNED) == 0
    visible = five.canvas.viewport.body.faces.nodes
    inside = int(visible[five.session.document.now.mesh.free[visible]][0])
    five.session.commands.pin(inside, True)
    five.refresh()
    assert texts(five.features["structure"].panel, "fixed")[1] == "1 pinned"
    nodes = five.canvas.viewport.structure.nodes.poly
    assert (nodes.cell_data["colours"] == tuple(bytes.fromhex(PINNED[1:]))).all(axis=1).sum() == 1
    five.session.commands.undo()
    five.refresh()
    assert len(texts(five.features["structure"].panel, "fixed")) == 1


def test_another_mesh_with_as_many_free_nodes_has_its_own_boundary(window, qtbot, tmp_path):
    mesh, one = grid(2), grid(1)
    apart = Mesh(
        np.concatenate([mesh.points, one.points + 9]), np.concatenate([mesh.hexes, one.hexes + len(mesh.points)])
    )
    panel = window.features["structure"].panel
    for name, each, boundary in (("one", mesh, 26), ("two", apart, 34)):
        io.write(tmp_path / f"{name}.vtu", each)
        open_and_wait(qtbot, window, tmp_path / f"{name}.vtu")
        window.refresh()
        assert texts(panel, "free") == ["1"]
        assert texts(panel, "fixed") == [f"{boundary} boundary"]


def test_locked_nodes_are_shown_and_drawn_in_pictures(window, qtbot, tmp_path):
    mesh = grid(3)
    points = mesh.points.copy()
    points[15] += [-1.5, 0, 0]
    io.write(tmp_path / "locked.vtu", Mesh(points, mesh.hexes))
    open_and_know(qtbot, window, tmp_path / "locked.vtu")
    press_key(window, "locked")
    assert count(pixels(window), LOCKED) > 20
    from PIL import Image

    assert window.features["save"].picture(tmp_path / "locked.png", (640, 480))
    image = np.asarray(Image.open(tmp_path / "locked.png").convert("RGB")).astype(int)
    assert count(image, LOCKED) > 20


@pytest.mark.parametrize("size", [(1440, 900), (1100, 700)])
def test_nothing_is_cut_off(five, qtbot, size):
    five.resize(*size)
    panel = five.features["structure"].panel
    panel.set_nodes(1_234_567, 12_345, 1_234_567, 12_345)
    five.session.view.change(structure=Structure(irregular=True))
    found = structure(tetrahedron())
    valence = np.repeat([3, 5, 6, 7, 8], [14_461, 10_776, 1_048, 303, 10])
    panel.set_found(type(found)(found.interior, valence, np.arange(8672), found.boundary, valence, found.sharp))
    five.refresh()
    turn()
    for layer in panel.layers.values():
        assert layer.box.width() >= layer.box.sizeHint().width()
        for label in layer.entries.findChildren(QLabel):
            if label.isVisible():
                assert label.width() >= label.fontMetrics().horizontalAdvance(label.text()), label.text()
    assert panel.mapTo(five, panel.rect().bottomRight()).x() < size[0]


def begin_searching(window):
    """Not waited for: a small mesh's search may be over between two looks at it."""
    window.session.finder.search()
    assert window.session.finder.busy


@pytest.mark.parametrize("searching", [False, True])
def test_closing_before_it_is_found_leaves_no_thread(fresh_window, qtbot, mesh_file, searching):
    window = fresh_window
    if window.session.finder.structure is None:
        qtbot.waitSignal(window.session.finder.found, timeout=PATIENCE).wait()
    window.session.document.replace(window.session.document.start, mesh_file)
    if searching:
        begin_searching(window)
    window.close()
    qtbot.waitUntil(lambda: running() == (), timeout=PATIENCE)
    turn()
    assert window.session.finder.structure is None


def test_of_meshes_opened_one_after_the_other_the_last_ones_structure_is_found(window, qtbot):
    first, last = State.of(gallery.make("five-side", size=30_000)), State.of(grid(2))
    window.session.document.replace(first, None)
    begin_searching(window)
    window.session.document.replace(last, None)
    qtbot.waitUntil(lambda: window.session.finder.structure is not None, timeout=PATIENCE)
    assert len(window.session.finder.structure.sharp) == 24


def test_other_cells_are_shown_and_told_of(window, qtbot, tmp_path):
    bare = grid(2, 2, 1)
    tip = bare.points[bare.hexes[0, 4:]].mean(axis=0) + [0, 0, 1]
    pyramid = Cells("pyramid", np.array([[*bare.hexes[0, 4:], bare.n_nodes]]))
    io.write(tmp_path / "mixed.exo", Mesh(np.vstack([bare.points, tip]), bare.hexes, cells=(pyramid,)))
    open_and_know(qtbot, window, tmp_path / "mixed.exo")
    (message,) = window.messages.messages()
    assert "1 pyramid cell beside the hexes" in message[1]
    assert window.canvas.viewport.others.shown
    layer = window.features["structure"].panel.layers["others"]
    assert layer.box.isVisibleTo(window.features["structure"].panel)
    assert texts(window.features["structure"].panel, "others") == ["1 pyramid"]
    press_key(window, "others")
    window.refresh()
    assert not window.canvas.viewport.others.shown
    press_key(window, "others")
    window.refresh()
    assert window.canvas.viewport.others.shown
    io.write(tmp_path / "plain.exo", bare)
    open_and_know(qtbot, window, tmp_path / "plain.exo")
    assert window.messages.messages() == []
    assert not window.canvas.viewport.others.shown
    assert not layer.box.isVisibleTo(window.features["structure"].panel)
