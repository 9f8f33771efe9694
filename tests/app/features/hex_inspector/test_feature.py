"""Selection of hexes and nodes in the window, by mouse and keys."""

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QAction
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QAbstractButton, QCheckBox, QComboBox, QTableView

from hexmend.mesh.solid_cells import kinds_of
from hexmend.quality import METRICS, measure
from hexmend_app.features.hex_inspector.hex_panel import HexPanel
from hexmend_app.features.hex_inspector.worst_list import ID, KIND, WorstList, write_worst
from hexmend_app.state.mesh.inspection import describe_hex, describe_node
from hexmend_app.state.mesh.selection import MAX_LISTED
from hexmend_app.widgets.action_button import ActionButton
from hexmend_app.widgets.link_label import LinkLabel
from hexmend_app.widgets.wording import figure
from tests.app.driving import LEFT, drag, heard_from, key, named, open_mesh, smooth, texts
from tests.app.invalid_hexes import BENT, INSIDE, THREE, VALID
from tests.core.boundary.solids import slid
from tests.core.grids import grid, scrambled
from tests.core.solid_lattices import mixed


def centre(window):
    return window.canvas.interactor.rect().center()


def click_view(window, modifier=Qt.KeyboardModifier.NoModifier, pos=None):
    """Click in the view and refresh the window."""
    QTest.mouseClick(window.canvas.interactor, LEFT, modifier, pos=centre(window) if pos is None else pos)
    window.refresh()


def test_a_click_in_the_view_selects_a_hex_and_a_drag_does_not(window, qtbot):
    for panel in ("hex", "worst"):
        window.show_panel(panel)
    click_view(window)
    chosen = window.session.selection.hex
    assert chosen is not None
    neighbours = window.session.document.now.mesh.topology.face_neighbours[chosen]
    assert (neighbours < 0).any()  # the visible hexes are at the surface
    assert window.is_visible("hex")
    click_view(window, pos=QPoint(3, 3))
    assert window.session.selection.hex is None
    drag(window.canvas.interactor, centre(window), centre(window) + QPoint(40, 0))
    assert window.session.selection.hex is None


@pytest.mark.slow
def test_keys_step_through_the_worst_hexes_and_the_camera_follows(window, qtbot):
    camera = window.canvas.viewport.camera
    before = np.array(camera.GetFocalPoint())
    key(window, Qt.Key.Key_N)
    worst = window.session.selection.hex
    assert worst == window.features["hex_inspector"].worst_list.hexes[0]
    middle = window.session.document.now.mesh.points[window.session.document.now.mesh.hexes[worst]].mean(axis=0)
    qtbot.waitUntil(lambda: np.allclose(camera.GetFocalPoint(), middle))
    assert not np.allclose(before, middle)
    key(window, Qt.Key.Key_N)
    key(window, Qt.Key.Key_N, Qt.KeyboardModifier.ShiftModifier)
    assert window.session.selection.hex == worst
    assert window.session.view.look.show.isolate.hexes == (worst,)
    key(window, Qt.Key.Key_Escape)
    assert window.session.view.look.show.isolate is None
    assert window.session.selection.hex == worst
    key(window, Qt.Key.Key_Escape)
    assert window.session.selection.hex is None


@pytest.mark.slow
def test_a_boundary_node_pinned_by_key_does_not_slide(window, qtbot, tmp_path):
    open_mesh(qtbot, window, tmp_path / "slid.vtu", slid(grid(4), 0.3, seed=3))
    mesh = window.session.document.now.mesh
    middle = (grid(4).points == (2, 2, 4)).all(axis=1)  # of the top
    node = int(np.flatnonzero(middle)[0])
    h = np.flatnonzero((mesh.hexes == node).any(axis=1))[0]
    assert not window.window_actions["pin"].isEnabled()
    window.session.selection.choose(int(h), node)
    window.show_panel("hex")
    window.refresh()
    pin = next(b for b in window.features["hex_inspector"].panel.findChildren(QCheckBox) if b.text() == "Pinned")
    assert pin.isEnabled()
    assert not pin.isChecked()
    key(window, Qt.Key.Key_P, Qt.KeyboardModifier.ShiftModifier)
    assert pin.isChecked()
    assert window.window_actions["pin"].isChecked()
    assert any(f"Node {node}: boundary, pinned" in text for text in texts(window.features["hex_inspector"].panel))
    smooth(qtbot, window.session, "mend", 30, boundary="slide")
    moved = (window.session.document.now.mesh.points != mesh.points).any(axis=1)
    assert moved[mesh.topology.boundary].sum() > 20
    assert not moved[node]
    window.session.commands.undo()
    window.session.commands.undo()
    window.refresh()
    assert not pin.isChecked()


def test_ctrl_click_hides_a_hex_and_backspace_shows_it(window, qtbot):
    click_view(window)
    first = window.session.selection.hex
    click_view(window, Qt.KeyboardModifier.ControlModifier)
    assert window.session.view.look.show.hidden == {first}
    assert window.session.selection.hex is None
    window.canvas.draw_still()
    click_view(window)
    behind = window.session.selection.hex
    assert behind not in (None, first)
    key(window, Qt.Key.Key_Delete)
    assert window.session.view.look.show.hidden == {first, behind}
    key(window, Qt.Key.Key_Backspace)
    assert window.session.view.look.show.hidden == {first}
    key(window, Qt.Key.Key_Backspace)
    assert not window.session.view.look.show.hidden


# Pinning all nodes outside the isolated hexes and the rings around them.


@pytest.mark.slow
def test_only_the_isolated_region_is_free_until_undo(window):
    session = window.session
    mesh = session.document.now.mesh
    session.view.isolate([40], 1)
    window.refresh()
    assert window.window_actions["free_isolated"].isEnabled()
    window.window_actions["free_isolated"].trigger()
    expected = np.zeros(mesh.n_nodes, dtype=bool)
    expected[mesh.hexes[mesh.topology.hexes_around([40], 1)]] = True
    np.testing.assert_array_equal(session.document.now.mesh.free, expected & mesh.free)
    assert session.document.undo_title == "free a region"
    session.commands.undo()
    np.testing.assert_array_equal(session.document.now.mesh.free, mesh.free)


# List of the worst hexes.


MESH = scrambled(grid(11), 0.7, 4)
FIGURES = measure(MESH.points, MESH.hexes)


@pytest.fixture
def worst_list(shown):
    widget = shown(WorstList(), 600, 300)
    widget.set_quality(MESH, FIGURES)
    actions = QAction("Previous", widget), QAction("Next", widget)
    for action, handle in zip(actions, (widget.previous, widget.next), strict=True):
        action.triggered.connect(handle)
    for shown_on, action in zip(widget.findChildren(ActionButton), actions, strict=True):
        shown_on.show_action(action)
    return widget


def button(widget, text):
    return next(b for b in widget.findChildren(QAbstractButton) if b.accessibleName() == text)


def row_at(widget, row):
    table = widget.findChild(QTableView)
    return table.viewport(), table.visualRect(table.model().index(row, 0)).center()


@pytest.mark.parametrize("name", METRICS)
def test_the_list_is_bounded_and_sorted_by_its_metric(worst_list, name):
    metric = worst_list.findChild(QComboBox)
    metric.setCurrentIndex(metric.findData(name))
    hexes, better = worst_list.hexes, METRICS[name].better or 1
    assert len(hexes) == min(MAX_LISTED, MESH.n_hexes) < MESH.n_hexes
    keys = better * METRICS[name].of(MESH.points, MESH.hexes, FIGURES)
    keys[np.isnan(keys)] = -np.inf
    listed = keys[hexes]
    soundness = np.select([FIGURES.inverted, FIGURES.invalid], [0, 1], 2)
    assert list(zip(soundness[hexes], listed, strict=True)) == sorted(zip(soundness, keys, strict=True))[: len(hexes)]
    equal = (listed[1:] == listed[:-1]) & (np.diff(soundness[hexes]) == 0)
    assert (np.diff(FIGURES.scaled_jacobian[hexes])[equal] >= 0).all()


def test_the_numbers_of_the_file_have_a_column_where_it_has_some(worst_list, tmp_path):
    table = worst_list.findChild(QTableView)
    assert table.isColumnHidden(ID)
    mesh = MESH.replace(hex_data={"id": np.arange(MESH.n_hexes)[::-1] + 7})
    worst_list.set_quality(mesh, FIGURES)
    assert not table.isColumnHidden(ID)
    worst = int(worst_list.hexes[0])
    assert table.model().index(0, ID).data() == str(MESH.n_hexes - 1 - worst + 7)
    write_worst(tmp_path / "worst.csv", mesh)
    head, first = (tmp_path / "worst.csv").read_text().splitlines()[:2]
    assert (head.split(",")[-1], first.split(",")[-1]) == ("id", str(MESH.n_hexes - 1 - worst + 7))


def test_invalid_hexes_are_listed_before_valid_ones_of_lower_quality(worst_list):
    mesh = scrambled(grid(6), 0.5, 2)
    figures = measure(mesh.points, mesh.hexes)
    worst_list.set_quality(mesh, figures)
    hexes, inside = worst_list.hexes, figures.invalid & ~figures.inverted
    assert inside.any()
    assert figures.q[figures.invalid].max() > figures.q[~figures.invalid].min()
    inverted, invalid = figures.n_inverted, figures.n_invalid
    assert figures.inverted[hexes[:inverted]].all()
    assert inside[hexes[inverted:invalid]].all()


def test_a_click_on_a_row_selects_its_hex(worst_list, qtbot):
    viewport, place = row_at(worst_list, 2)
    with qtbot.waitSignal(worst_list.chosen) as chosen:
        QTest.mouseClick(viewport, Qt.MouseButton.LeftButton, pos=place)
    assert chosen.args == [worst_list.hexes[2]]


def test_next_and_previous_step_from_the_selected_hex_and_wrap_around(worst_list):
    selected = heard_from(worst_list.chosen)
    worst_list.chosen.connect(worst_list.set_selected)
    for text in ("Next", "Next", "Previous", "Previous"):
        QTest.mouseClick(button(worst_list, text), Qt.MouseButton.LeftButton)
    hexes = worst_list.hexes.tolist()
    assert selected == [hexes[0], hexes[1], hexes[0], hexes[-1]]


def test_the_selected_row_follows_its_hex_when_the_mesh_changes(worst_list):
    hex = int(worst_list.hexes[5])
    worst_list.set_selected(hex)
    better = scrambled(grid(11), 0.5, 4)
    worst_list.set_quality(better, measure(better.points, better.hexes))
    row = worst_list.findChild(QTableView).currentIndex().row()
    listed = worst_list.hexes.tolist()
    assert (listed[row] == hex) if hex in listed else row == -1


# Panel of the selected hex.


SMALL = scrambled(grid(5), 0.9, 4)
WORST_OF_SMALL = int(measure(SMALL.points, SMALL.hexes).scaled_jacobian.argmin())


@pytest.fixture
def panel(shown):
    return shown(HexPanel(), 520, 260)


def test_without_a_hex_the_panel_shows_a_hint(panel):
    panel.show_hex(None)
    assert any("Click a hex" in text for text in texts(panel))


def test_a_hex_is_shown_with_metrics_nodes_and_neighbours(panel):
    details = describe_hex(SMALL, WORST_OF_SMALL)
    panel.show_hex(details)
    shown = texts(panel)
    assert f"Hex {WORST_OF_SMALL}" in shown
    assert f"inverted; det J min / max {figure(details.least_jacobian)}" in shown
    assert all(any(f">{node}<" in text for text in shown) for node in details.nodes)
    assert any(f">{details.values['q']:.4f}<" in text for text in shown)
    (corners,) = (text for text in shown if "q(T)" in text)
    assert corners.count(">free<") + corners.count(">fixed<") == 8
    neighbour = next(h for h in details.neighbours if h >= 0)
    assert f'href="{neighbour}"' in named(panel, LinkLabel, "Neighbours").text()


def test_a_hex_that_is_invalid_inside_is_called_so_with_its_least_determinant(panel):
    panel.show_hex(describe_hex(THREE, INSIDE))
    (state,) = (text for text in texts(panel) if text.startswith("invalid inside; det J min / max "))
    assert float(state.split()[-1].replace("−", "-")) == pytest.approx(-1 / 8, abs=2e-3)
    panel.show_hex(describe_hex(BENT, 0))  # by its map of second order
    assert any(text.startswith("invalid inside; det J min / max −") for text in texts(panel))
    panel.show_hex(describe_hex(THREE, VALID))
    assert not any("det J" in text for text in texts(panel))


def test_the_numbers_of_the_file_are_named_too(panel):
    ids = {"hex_data": {"id": np.arange(SMALL.n_hexes) + 501}, "node_data": {"id": np.arange(SMALL.n_nodes) + 1001}}
    mesh = SMALL.replace(**ids)
    node = int(mesh.hexes[WORST_OF_SMALL][0])
    panel.show_hex(describe_hex(mesh, WORST_OF_SMALL))
    panel.show_node(describe_node(mesh, node))
    shown = texts(panel)
    assert any(text.startswith(f"Number in the file: {WORST_OF_SMALL + 501}<br>") for text in shown)
    assert any(text.startswith(f"Node {node} ({node + 1001} in the file): ") for text in shown)
    from_zero = SMALL.replace(hex_data={"id": np.arange(SMALL.n_hexes)})
    panel.show_hex(describe_hex(from_zero, WORST_OF_SMALL))
    assert not any("in the file:" in text for text in texts(panel))


# Meshes of hexes, wedges, pyramids and tetrahedra.


MIXED = scrambled(mixed(3), 0.1)
NAMES = np.array(["hex", "wedge", "pyramid", "tetrahedron"])


def test_cells_of_all_kinds_are_listed_with_their_kind(worst_list, tmp_path):
    table = worst_list.findChild(QTableView)
    assert table.isColumnHidden(KIND)
    figures = measure(MIXED.points, MIXED.elements)
    worst_list.set_quality(MIXED, figures)
    assert not table.isColumnHidden(KIND)
    kinds = NAMES[kinds_of(MIXED.elements)]
    assert [table.model().index(row, KIND).data() for row in range(72)] == kinds[worst_list.hexes].tolist()
    assert "72 cells, 0 inverted, 0 invalid." in " ".join(texts(worst_list))
    write_worst(tmp_path / "worst.csv", MIXED)
    head, first = (line.split(",") for line in (tmp_path / "worst.csv").read_text().splitlines()[:2])
    assert (head[-1], first[-1]) == ("kind", kinds[int(first[0])])


def test_valid_cells_without_a_value_are_listed_last(worst_list):
    metric = worst_list.findChild(QComboBox)
    metric.setCurrentIndex(metric.findData("skew"))
    worst_list.set_quality(MIXED, measure(MIXED.points, MIXED.elements))
    assert set(worst_list.hexes[:12]) == set(range(MIXED.n_hexes))


@pytest.mark.parametrize(("kind", "nodes", "faces"), [(1, 6, 5), (2, 5, 5), (3, 4, 4)])
def test_a_cell_is_shown_with_its_own_nodes_corners_and_neighbours(panel, kind, nodes, faces):
    name = NAMES[kind]
    cell = int(np.flatnonzero(kinds_of(MIXED.elements) == kind)[0])
    details = describe_hex(MIXED, cell)
    assert (details.nodes.size, details.neighbours.size) == (nodes, faces)
    quality = measure(MIXED.points, MIXED.elements)
    assert details.values["q"] == pytest.approx(quality.q[cell])
    assert np.nanmean(details.corners) == pytest.approx(quality.q[cell])
    assert np.isnan(details.corners).sum() == (name == "pyramid")  # its apex has no corner tetrahedron
    panel.show_hex(details)
    shown = texts(panel)
    assert f"{name.capitalize()} {cell}" in shown
    (corners,) = (text for text in shown if "q(T)" in text)
    assert corners.count(">free<") + corners.count(">fixed<") == nodes
    panel.show_node(describe_node(MIXED, int(details.nodes[0])))
    assert any(" cells, " in text for text in texts(panel))


@pytest.mark.slow
def test_a_click_in_a_mixed_mesh_selects_a_tetrahedron(window, qtbot, tmp_path):
    open_mesh(qtbot, window, tmp_path / "mixed.vtu", mixed(3))
    window.canvas.viewport.view("+z")
    window.canvas.draw_still()
    click_view(window, pos=centre(window) - QPoint(40, 3))
    selected = window.session.selection.hex
    mesh = window.session.document.now.mesh
    assert NAMES[kinds_of(mesh.elements[[selected]])[0]] == "tetrahedron"
    window.show_panel("hex")
    assert f"Tetrahedron {selected}" in texts(window.features["hex_inspector"].panel)
    layer = window.canvas.viewport.overlay_layers.selection
    assert layer.highlight.edges.lines.n_cells == 6
