"""The doctor finds what was done to a mesh, and nothing in a sound one."""

import numpy as np
import pytest

from hexmend.io.doctor import examine, mirrored
from hexmend.mesh import Mesh
from hexmend.quality import measure
from tests.core.grids import grid

SOUND = grid(3)


def test_a_sound_mesh_has_no_findings():
    assert examine(SOUND) == ()


def with_hexes(hexes):
    return Mesh(SOUND.points, hexes)


@pytest.mark.parametrize(
    ("mesh", "kind", "count"),
    [
        (Mesh(np.vstack([SOUND.points, [[9, 9, 9]]]), SOUND.hexes), "unused-nodes", 1),
        (with_hexes(np.vstack([SOUND.hexes, SOUND.hexes[:2]])), "duplicate-hexes", 2),
        (with_hexes(np.where(SOUND.hexes == SOUND.hexes[0, 6], SOUND.hexes[0, 5], SOUND.hexes)), "degenerate-hexes", 4),
        (with_hexes(SOUND.hexes[[0, 26]]), "parts", 1),
        (mirrored(SOUND), "mirrored", 27),
        (
            Mesh(np.vstack([SOUND.points, SOUND.points]), np.vstack([SOUND.hexes, SOUND.hexes + 64])),
            "coincident-nodes",
            64,
        ),
    ],
)
def test_trouble_is_found_and_counted(mesh, kind, count):
    found = {finding.kind: finding for finding in examine(mesh)}
    assert kind in found
    assert found[kind].count == count
    assert f"{count:,}" in found[kind].message


def test_mirroring_turns_hexes_outside_out():
    bad = mirrored(SOUND)
    assert measure(bad.points, bad.hexes).n_inverted == 27
    again = mirrored(bad)
    np.testing.assert_array_equal(again.hexes, SOUND.hexes)
