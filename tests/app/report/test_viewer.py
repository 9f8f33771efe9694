"""The mesh data of a page: measured values, to the precision of a screen."""

import base64
import gzip
import os
import signal
from collections import Counter

import numpy as np
import pytest
from markupsafe import Markup

from hexmend import METHODS, METRICS, Run, StoppingCriteria, gallery
from hexmend.cli.process.interrupts import ExitAfterIteration
from hexmend.mesh.hexahedron import FACES
from hexmend_app.report import case
from hexmend_app.report import viewer as module
from hexmend_app.report.case import Version, run_methods
from hexmend_app.report.templates import html
from hexmend_app.report.viewer import packed, viewer
from tests.core.solid_lattices import mixed


@pytest.fixture(scope="module")
def kept(case):
    return packed(case.versions)


def array(blob, place, kind):
    """Decode an array of the blob."""
    data, (start, count) = gzip.decompress(base64.b64decode(blob)), place
    width = np.dtype(kind).itemsize
    planes = np.frombuffer(data, np.uint8)[start : start + count * width].reshape(width, count)
    return np.ascontiguousarray(planes.T).view(kind).ravel()


def test_hexes_and_positions_are_decoded(kept, case):
    head, blob = kept
    mesh = case.initial.mesh
    assert (np.cumsum(array(blob, head["hexes"], "<i4").reshape(-1, 8), axis=0) == mesh.hexes).all()
    size = np.linalg.norm(np.ptp(mesh.points, axis=0)) / 2
    for state, version in zip(head["states"], case.versions, strict=True):
        points = array(blob, state["points"], "<f4").reshape(-1, 3) * size
        way = points - version.mesh.points
        assert np.abs(way - way.mean(axis=0)).max() < 1e-6 * size
        kinds = array(blob, state["kinds"], "u1")
        assert ((kinds == 1) == version.quality.inverted).all()
        assert ((kinds > 0) == version.quality.invalid).all()


@pytest.mark.parametrize("name", [*METRICS])
def test_values_are_decoded(kept, case, name):
    head, blob = kept
    at = [*METRICS].index(name)
    kind = head["metrics"][at]
    assert kind["name"] == name
    for state, version in zip(head["states"], case.versions, strict=True):
        steps = array(blob, state["values"][at], "<u2").astype(float)
        values = kind["from"] + (kind["to"] - kind["from"]) * steps / kind["steps"]
        measured = METRICS[name].of(version.mesh.points, version.mesh.hexes, version.quality)
        wanted = np.clip(measured, kind["from"], kind["to"])
        assert np.abs(values - wanted).max() <= 0.51 * (kind["to"] - kind["from"]) / kind["steps"]


def test_the_same_mesh_makes_the_same_page(kept, case):
    assert packed(case.versions) == kept


def test_no_name_can_end_a_script():
    page = html.viewer("", ["", ""], {"name": "</script><!--"}, "")
    assert page.count("</script>") == 2
    assert "<!--" not in page


def test_a_mesh_too_large_for_a_browser_is_a_picture_with_the_reason(case, monkeypatch):
    monkeypatch.setattr(module, "MOST_HEXES", 10)
    page = viewer([case.initial], Markup("<figure>picture</figure>"))
    assert "<figure>picture</figure>" in page
    assert "864 hexes, at most 10" in page
    assert "<canvas" not in page


# The runs of a report.


def test_an_interrupt_between_two_methods_keeps_those_that_are_done(monkeypatch):
    def run_one(mesh, smoother, stop, watch):
        if smoother.name == "local-sd":
            raise KeyboardInterrupt
        return whole(mesh, smoother, stop, watch)

    whole = case.run_one
    monkeypatch.setattr(case, "run_one", run_one)
    mesh = gallery.make("cube", size=27, scramble=0.3)
    done = run_methods(mesh, None, [METHODS["laplacian"](), METHODS["local-sd"]()], StoppingCriteria(max_iterations=3))
    assert done.interrupted
    assert [one.name for one in done.versions][1:] == ["laplacian"]


@pytest.mark.parametrize(("owner", "name"), [(case, "summarise"), (case, "advise"), (Run, "result")])
def test_a_second_signal_after_the_last_iteration_keeps_what_the_run_reached(monkeypatch, owner, name):
    whole, sent = getattr(owner, name), []
    methods = [METHODS["laplacian"](), METHODS["local-sd"]()]

    def interrupted(*args):
        if signals.asked and not sent:
            sent.append(signal.SIGINT)
            os.kill(os.getpid(), signal.SIGINT)
        return whole(*args)

    def ask(run):
        os.kill(os.getpid(), signal.SIGINT)

    monkeypatch.setattr(owner, name, interrupted)
    mesh = gallery.make("cube", size=27, scramble=0.3)
    with ExitAfterIteration() as signals:
        done = run_methods(mesh, None, methods, StoppingCriteria(max_iterations=1), watch=ask)
    assert done.interrupted
    assert [one.name for one in done.versions] == ["initial", "laplacian"]


def test_the_faces_of_collapsed_hexes_are_those_of_cells_of_all_kinds():
    mesh = mixed(3)
    head, blob = packed([Version.of("original", mesh)])
    assert head["nouns"] == ("cell", "cells")
    rows = np.cumsum(array(blob, head["hexes"], "<i4").reshape(-1, 8), axis=0)
    found = Counter(frozenset(face) for face in rows[:, FACES].reshape(-1, 4).tolist() if len(set(face)) > 2)
    outside = {frozenset(face) for face in mesh.topology.boundary_faces.tolist()}
    assert {face for face, cells in found.items() if cells == 1} == outside
    assert max(found.values()) == 2
