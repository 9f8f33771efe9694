"""What a mesh and a result look like in a notebook, where nothing draws meshes."""

import xml.etree.ElementTree as ET
from types import SimpleNamespace

import pytest

import hexmend as hx
from hexmend import HexmendError, StoppingCriteria
from hexmend.notebook import of_mesh, of_result
from hexmend.quality.summary import SUMMARY_QUANTITIES


@pytest.fixture(scope="module")
def mesh():
    return hx.gallery.make("bridge-sharp", size=500, scramble=0.4, seed=1)


@pytest.fixture(scope="module")
def result(mesh):
    return hx.smooth(mesh, "laplacian", StoppingCriteria(max_iterations=5, tolerance=0))


@pytest.fixture
def drawing(monkeypatch):
    """Let something draw meshes, or nothing."""

    def draw(**entries):
        found = {name: SimpleNamespace(load=lambda one=one: one) for name, one in entries.items()}
        monkeypatch.setattr(
            "importlib.metadata.entry_points", lambda group, name: [found[name]] if name in found else []
        )

    return draw


def texts(html):
    return [" ".join(one.itertext()) for one in ET.fromstring(html).iter("tr")]


def test_a_mesh_is_a_table_of_its_figures(mesh):
    rows = texts(of_mesh(mesh.replace(name="a <b> & c")))
    assert len(rows) == len(SUMMARY_QUANTITIES)
    assert rows[0].split() == ["hexes", f"{mesh.n_hexes:,}"]


def test_a_result_is_a_table_of_before_and_after(result):
    tree = ET.fromstring(of_result(result))
    assert tree.find(".//p").text == result.message
    cells = [one.text for one in next(row for row in tree.iter("tr") if "q mean" in "".join(row.itertext())).iter("td")]
    assert cells[:2] == [
        SUMMARY_QUANTITIES["q_mean"].text(result.before.q_mean),
        SUMMARY_QUANTITIES["q_mean"].text(result.after.q_mean),
    ]


def test_what_is_worse_is_red(mesh):
    worse = hx.smooth(mesh, "laplacian", StoppingCriteria(max_iterations=1, keep_last=True))
    red = sum("#b3261e" in (cell.get("style") or "") for cell in ET.fromstring(of_result(worse)).iter("td"))
    assert red == len(set(worse.worse) & set(SUMMARY_QUANTITIES))


def test_without_the_viewer_it_is_said_why_there_is_no_picture(mesh, drawing):
    drawing()
    assert ".[app,notebook]" in mesh._repr_html_()
    with pytest.raises(HexmendError, match=r"\.\[app,notebook\]"):
        hx.view(mesh)


def test_what_cannot_draw_here_says_so_below_the_table(mesh, drawing):
    drawing(still=fails)
    html = mesh._repr_html_()
    assert "no graphics here" in html
    assert "<img" not in html


def test_what_draws_gives_the_picture(result, drawing):
    drawing(still=draws)
    (image,) = ET.fromstring(result._repr_html_()).iter("img")
    assert image.get("src") == "data:image/png;base64,OTYweDY0MA=="


def draws(mesh, size):
    return "{}x{}".format(*size).encode()


def fails(mesh, size):
    raise HexmendError("no graphics here")
