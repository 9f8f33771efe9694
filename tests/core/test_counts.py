"""Sentences with a count: none, one and several things are each in the right number."""

import re

import numpy as np
import pytest

from hexmend import Mesh, advise, measure, smooth
from hexmend.boundary import SurfaceChange
from hexmend.doctor import examine
from hexmend.mesh.orientation import with_consistent_orientation
from hexmend.run.messages import name_invalid
from hexmend.smoothers.mend.messages import freed_message, omission_message
from tests.core.grids import grid

#: A number 1 before a plural, or another one before a singular; "0 of 1 hexes" too.
_THINGS = "node|hexe?|corner|face|edge|iteration|layer|part|material|cell|time"
_WRONG = re.compile(
    rf"\b1 (?:{_THINGS.replace('hexe?', 'hexe')})s\b|\b(?:0|[2-9]|\d\d+) (?:{_THINGS.replace('e?', '')})\b"
)


def checked(text):
    """Return a text of which every count is in the right number."""
    assert not _WRONG.search(text), text
    assert not re.search(r"\b1 (?:of [^.;,]*)?(?:are|were|have)\b|\b[02] (?:is|was|has)\b", text), text
    return text


def test_the_check_finds_what_is_wrong():
    for wrong in ("1 nodes", "0 of 1 hexes", "2 hex moved", "1 were inverted"):
        with pytest.raises(AssertionError):
            checked(wrong)
    checked("1 node; 0 nodes; 2 hexes; 0 of 1 hex")


@pytest.mark.parametrize("count", range(3))
def test_changes_of_a_surface(count):
    change = SurfaceChange(0.1, 0.1, 1.0, 1.0, 0.0, count, count, min(count, 1))
    said = checked(change.sentence)
    began = {
        0: "The boundary could slide, but none of its nodes moved: it is at most",
        1: "The boundary slid: 1 of its",
    }
    assert said.startswith(began.get(count, "The boundary slid: 2 of its nodes moved; it is at most"))


@pytest.mark.parametrize("count", range(3))
def test_corners_that_mend_omits_or_frees(count):
    bits = np.zeros(5, dtype=np.uint8)
    bits[:count] = 1
    checked(omission_message(count, 0))
    checked(omission_message(0, count))
    checked(freed_message(bits, bits))
    checked(freed_message(bits, bits * 0))


@pytest.mark.parametrize("count", [1, 2, 8])
def test_orientation(count):
    parts = [grid(1).points + [3 * at, 0, 0] for at in range(count)] + [grid(1).points + [0, 5, 0]] * (count < 8)
    hexes = np.arange(8 * len(parts)).reshape(-1, 8)
    hexes[:count] = hexes[:count, [4, 5, 6, 7, 0, 1, 2, 3]]
    corners = grid(1).hexes[0]
    mesh = Mesh(np.concatenate([part[corners] for part in parts]), hexes)
    read = with_consistent_orientation(mesh)
    (note,) = read.notes
    assert read.renumbered == "parts"
    assert checked(note).endswith("numbered inside out in the file (left-handed), and renumbered on reading.")
    for finding in examine(mesh):
        checked(finding.message)


@pytest.mark.parametrize("n", [1, 2])
def test_runs_on_small_meshes(n):
    mesh = grid(n, 1, 1)
    for given in (mesh, mesh.with_points(np.where(np.arange(mesh.n_nodes)[:, None] == 0, 0.7, mesh.points))):
        for settings in ({}, {"boundary": "slide"}, {"boundary": "slide", "max_iterations": 1}):
            result = smooth(given, **settings)
            advice = advise(result)
            for text in (
                result.message,
                advice.state,
                advice.reason,
                advice.surface,
                *(s.text for s in advice.suggestions),
            ):
                checked(text)


def test_invalid_hexes_are_named_with_the_ids_of_the_file():
    mesh = grid(2)
    points = mesh.points.copy()
    points[0] = 1.5
    mesh = mesh.with_points(points).replace(hex_data={"id": np.arange(8) + 100})
    assert "Invalid hexes: 0 (in the file 100)" in name_invalid(mesh, measure(points, mesh.hexes))
