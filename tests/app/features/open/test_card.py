"""Card after opening: what the mesh is, what is wrong with it, and what to do next."""

import numpy as np
import pytest

from hexmend import gallery, io
from hexmend.gallery import make
from hexmend.mesh.mesh import Mesh
from hexmend_app.features.open.opening_card import card
from hexmend_app.state.mesh.document import State
from tests.app.driving import open_and_wait
from tests.app.invalid_hexes import INSIDE, THREE
from tests.core.smoothers.mend.test_mend import with_locked_corner
from tests.patience import PATIENCE


def text_of(mesh):
    return card("a.vtu", State.of(mesh), ())[1]


def test_it_counts_and_says_what_to_do():
    title, text = card("a.vtu", State.of(make("bridge-sharp", size=864, scramble=0.6)), ())
    assert title.startswith("a.vtu: 864 hexes, ")
    assert "Run Mend to untangle them" in text
    assert text_of(make("cube", size=27)) == "No hex is invalid. Minimum scaled Jacobian 1.000."
    flat = make("cube", size=27)
    assert "some have a low quality" in text_of(
        flat.with_points(flat.points * [1, 1, 1] + 1.3 * np.sin(flat.points[:, ::-1] * 7) / 7)
    )


def test_it_says_that_hexes_are_invalid_inside():
    inside = Mesh(THREE.points[THREE.hexes[INSIDE]], [range(8)])
    title, text = card("a.vtu", State.of(inside), ())
    assert title == "a.vtu: 1 hex, 0 inverted, 1 invalid"
    assert text.startswith("Solvers may reject 1 hex invalid inside, between valid corners.")


def test_it_says_what_fixed_nodes_hold():
    mesh = with_locked_corner(gallery.make("five-side", size=300))
    assert "Fixed nodes" in text_of(mesh)


def test_it_counts_materials():
    assert "2 materials." in text_of(make("materials", size=300))


@pytest.mark.slow
def test_the_doctor_is_heard_on_the_card(window, qtbot, tmp_path):
    mesh = make("cube", size=27)
    twice = Mesh(np.concatenate([mesh.points, mesh.points + [mesh.points[:, 0].max(), 0, 0]]),
                 np.concatenate([mesh.hexes, mesh.hexes + mesh.n_nodes]))  # fmt: skip
    io.write(tmp_path / "blocks.vtu", twice)
    open_and_wait(qtbot, window, tmp_path / "blocks.vtu")
    assert window.messages.title.text().startswith("blocks.vtu: 54 hexes, 0 inverted, 0 invalid")
    qtbot.waitUntil(lambda: "The doctor found" in window.messages.text.text(), timeout=PATIENCE)
