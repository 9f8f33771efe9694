"""Panel of the selected hex."""

import numpy as np
import pytest

from hexmend.quality import measure
from hexmend_app.features.hex_inspector.hex_panel import HexPanel
from hexmend_app.state.mesh.inspection import describe_hex, describe_node
from hexmend_app.widgets.link_label import LinkLabel
from hexmend_app.widgets.wording import figure
from tests.app.driving import named, texts
from tests.app.invalid_hexes import BENT, INSIDE, THREE, VALID
from tests.core.grids import grid, scrambled

MESH = scrambled(grid(5), 0.9, 4)
WORST = int(measure(MESH.points, MESH.hexes).scaled_jacobian.argmin())


@pytest.fixture
def panel(qtbot):
    widget = HexPanel()
    qtbot.addWidget(widget)
    widget.resize(520, 260)
    widget.show()
    return widget


def test_without_a_hex_the_panel_shows_a_hint(panel):
    panel.show_hex(None)
    assert any("Click a hex" in text for text in texts(panel))


def test_a_hex_is_shown_with_metrics_nodes_and_neighbours(panel):
    details = describe_hex(MESH, WORST)
    panel.show_hex(details)
    shown = texts(panel)
    assert f"Hex {WORST:,}" in shown
    assert f"inverted; det J min / max {figure(details.least_jacobian)}" in shown
    assert all(any(f">{node:,}<" in text for text in shown) for node in details.nodes)
    assert f"{details.values['q']:.4f}" in shown
    assert shown.count("free") + shown.count("fixed") == 8


def test_a_hex_that_is_invalid_inside_is_called_so_with_its_least_determinant(panel):
    panel.show_hex(describe_hex(THREE, INSIDE))
    (state,) = (text for text in texts(panel) if text.startswith("invalid inside; det J min / max "))
    assert float(state.split()[-1].replace("−", "-")) == pytest.approx(-1 / 8, abs=2e-3)
    panel.show_hex(describe_hex(BENT, 0))  # by its map of second order
    assert any(text.startswith("invalid inside; det J min / max −") for text in texts(panel))
    panel.show_hex(describe_hex(THREE, VALID))
    assert not any("det J" in text for text in texts(panel))


def test_the_numbers_of_the_file_are_named_too(panel):
    ids = {"hex_data": {"id": np.arange(MESH.n_hexes) + 501}, "node_data": {"id": np.arange(MESH.n_nodes) + 1001}}
    mesh = MESH.replace(**ids)
    node = int(mesh.hexes[WORST][0])
    panel.show_hex(describe_hex(mesh, WORST))
    panel.show_node(describe_node(mesh, node))
    shown = texts(panel)
    assert any(text.startswith(f"Number in the file: {WORST + 501}<br>") for text in shown)
    assert any(text.startswith(f"Node {node:,} ({node + 1001} in the file): ") for text in shown)
    from_zero = MESH.replace(hex_data={"id": np.arange(MESH.n_hexes)})
    panel.show_hex(describe_hex(from_zero, WORST))
    assert not any("in the file:" in text for text in texts(panel))


def test_neighbours_are_links(panel):
    details = describe_hex(MESH, WORST)
    panel.show_hex(details)
    links, neighbour = named(panel, LinkLabel, "Neighbours"), next(h for h in details.neighbours if h >= 0)
    assert f'href="{neighbour}"' in links.text()
