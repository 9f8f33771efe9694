"""Mesh figures of the study, drawn without a display."""

import os
import subprocess
import sys

import numpy as np
import pytest
from PIL import Image

from hexmend.study.thesis.mesh_figures import MESH_FIGURES
from hexmend_app.scene.render.colour_count import count_colours

#: Program that draws every figure, of small meshes.
DRAW = """
import sys
from pathlib import Path
from hexmend.gallery import make
from hexmend.study.thesis.mesh_figures import MESH_FIGURES
from hexmend_app.cli.figures import draw
for figure in MESH_FIGURES:
    draw(figure, make(figure.mesh, size=3000), Path(sys.argv[1]) / f"{figure.number}.png")
"""


@pytest.fixture(scope="module")
def drawn(tmp_path_factory):
    folder = tmp_path_factory.mktemp("figures")
    environment = {key: value for key, value in os.environ.items() if key not in ("DISPLAY", "WAYLAND_DISPLAY")}
    subprocess.run([sys.executable, "-c", DRAW, str(folder)], env=environment, check=True)
    return {figure.number: folder / f"{figure.number}.png" for figure in MESH_FIGURES}


@pytest.mark.slow
@pytest.mark.parametrize("figure", MESH_FIGURES, ids=lambda figure: figure.number)
def test_a_figure_is_small_and_shows_something(drawn, figure):
    path = drawn[figure.number]
    assert path.stat().st_size < 150_000
    image = Image.open(path)
    assert image.size[0] == 900
    colours, counts = count_colours(np.asarray(image.convert("RGB")))
    assert len(colours) > 8
    assert counts.max() < 0.99 * counts.sum()  # not the background alone


def test_sections_alone_are_coloured_by_quality(drawn):
    """Only pictures of q(H) have vivid colours and a colour bar."""
    for figure in MESH_FIGURES:
        pixels = np.asarray(Image.open(drawn[figure.number]).convert("RGB")).astype(int)
        vivid = float((np.ptp(pixels, axis=2) > 120).mean())
        assert (vivid > 0.2) is (figure.shows == "section"), figure.number


def test_sections_have_one_plane_and_one_camera(drawn):
    """The three pictures of one mesh are identical."""
    pictures = [drawn[figure.number].read_bytes() for figure in MESH_FIGURES if figure.shows == "section"]
    assert len(pictures) == 3
    assert len(set(pictures)) == 1
