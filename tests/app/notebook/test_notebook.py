"""Meshes and results in an executed notebook."""

import asyncio
import base64
import os
import xml.etree.ElementTree as ET
from importlib.metadata import entry_points
from io import BytesIO

import numpy as np
import pytest
from PIL import Image

from hexmend_app.scene.render.colour_count import count_colours

CELLS = (
    "import hexmend as hx\nmesh = hx.gallery.make('bridge-sharp', size=500, scramble=0.4, seed=1)\nmesh",
    "hx.smooth(mesh, 'local-sd')",
    "hx.view(mesh, 'scaled-jacobian')",
    "hx.view(mesh, 'no-such-metric')",
)


@pytest.fixture(scope="module")
def outputs(tmp_path_factory):
    """Output of the cells: a mapping of types for each, or the message of an error."""
    nbclient, nbformat = pytest.importorskip("nbclient"), pytest.importorskip("nbformat")
    pytest.importorskip("trame_pyvista")
    folder = tmp_path_factory.mktemp("notebook")
    environment = {
        "JUPYTER_PLATFORM_DIRS": "1",
        "IPYTHONDIR": str(folder),
        "JUPYTER_RUNTIME_DIR": str(folder),
    }
    if not list(entry_points(group="hexmend.pictures")):  # as an installed Hexmend has them
        site = folder / "site"  # which is not IPython's folder: that one is no place of modules
        info = site / "pictures-1.0.dist-info"
        info.mkdir(parents=True)
        (info / "METADATA").write_text("Metadata-Version: 2.1\nName: pictures\nVersion: 1.0\n")
        (info / "entry_points.txt").write_text(
            "[hexmend.pictures]\nstill = hexmend_app.notebook.still:still\nview = hexmend_app.notebook.view:view\n"
        )
        environment["PYTHONPATH"] = os.pathsep.join(filter(None, [str(site), os.environ.get("PYTHONPATH")]))
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(cell) for cell in CELLS])
    client = nbclient.NotebookClient(notebook, timeout=240, kernel_name="python3", allow_errors=True)
    with pytest.MonkeyPatch.context() as patch:
        for name, value in environment.items():
            patch.setenv(name, value)
        asyncio.run(client.async_execute())
    return [
        [one.get("data") or one.get("evalue") for one in cell.outputs if one.output_type != "stream"]
        for cell in notebook.cells
    ]


def picture(html):
    (image,) = ET.fromstring(html).iter("img")
    return np.asarray(Image.open(BytesIO(base64.b64decode(image.get("src").split(",", 1)[1]))).convert("RGB"))


def test_a_mesh_shows_its_picture_and_its_figures(outputs):
    (shown,) = outputs[0]
    pixels = picture(shown["text/html"])
    assert pixels.shape == (640, 960, 3)
    assert len(count_colours(pixels)[0]) > 100
    assert "scaled Jacobian min" in shown["text/html"]


def test_a_result_shows_its_run(outputs):
    (shown,) = outputs[1]
    assert "<polyline" in shown["text/html"]
    assert "<th>before</th><th>after</th>" in shown["text/html"]


def test_a_view_is_interactive(outputs):
    (shown,) = outputs[2]
    assert {"text/html", "application/vnd.jupyter.widget-view+json"} & set(shown)


def test_an_unknown_metric_is_reported(outputs):
    (said,) = outputs[3]
    assert "no-such-metric" in said
