"""Export of the histogram as a picture and as CSV."""

import csv
import xml.etree.ElementTree as ET

import pytest

from hexmend.gallery import make
from hexmend.mesh.mesh import Mesh
from hexmend.quality import measure
from hexmend_app.features.histogram.histogram_file import HistogramExport

BLUE = "#0072b2"


@pytest.fixture(scope="module")
def mesh():
    return make("cube", size=1000, scramble=0.2, seed=1)


def rows(path):
    return list(csv.reader(path.read_text().splitlines()))


@pytest.mark.parametrize("log", [False, True])
def test_a_tall_bar_of_inverted_hexes_is_broken_and_labelled_in_the_figure(mesh, tmp_path, log):
    for inverted, broken in ((invert(mesh, 990), True), (invert(mesh, 3), False)):
        path = tmp_path / "figure.svg"
        HistogramExport("title", "q", [("now", BLUE, True, inverted)], log=log).write(path)
        ET.parse(path)
        count = measure(inverted.points, inverted.hexes).n_inverted
        assert (f">{count:,}<" in path.read_text()) == broken


def invert(mesh, count):
    """Return a mesh with the first `count` hexes inverted."""
    hexes = mesh.hexes.copy()
    hexes[:count] = hexes[:count][:, [4, 5, 6, 7, 0, 1, 2, 3]]
    return Mesh(mesh.points, hexes)


def counted(mesh, folder, bins=50, cumulative=False):
    path = folder / "counts.csv"
    HistogramExport("title", "q", [("now", BLUE, True, mesh)], bins=bins, cumulative=cumulative).write(path)
    return rows(path)


def test_the_csv_has_a_line_for_each_cell(mesh, tmp_path):
    lines = counted(mesh, tmp_path)
    assert lines[0] == ["q from", "q to", "now"]
    assert lines[1] == ["inverted", "inverted", str(measure(mesh.points, mesh.hexes).n_inverted)]
    assert len(lines) == 2 + 50
    assert sum(int(row[2]) for row in lines[1:]) == mesh.n_hexes


def test_the_axis_fits_the_first_mesh(mesh, tmp_path):
    path = tmp_path / "volume.csv"
    flat = mesh.with_points(mesh.points * [1, 1, 0.01])
    HistogramExport("title", "volume", [("at the start", BLUE, True, mesh), ("now", BLUE, True, flat)]).write(path)
    edges = [row[0] for row in rows(path)]
    HistogramExport("title", "volume", [("at the start", BLUE, True, mesh)]).write(path)
    assert [row[0] for row in rows(path)] == edges
