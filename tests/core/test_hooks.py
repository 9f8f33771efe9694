"""Hooks: functions of higher layers that classes of lower ones call."""

import subprocess
import sys

import pytest

from hexmend.hooks import hook


@pytest.mark.parametrize(
    "name", ["fixed_sets", "html", "plot", "quality", "region", "summary", "with_rules", "worst_hexes"]
)
def test_each_hook_has_a_provider(name):
    assert callable(hook(name))


def test_a_mesh_measures_itself_before_quality_is_imported():
    program = """
import sys
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.hexahedron import UNIT_CUBE
assert "hexmend.quality" not in sys.modules
mesh = Mesh(UNIT_CUBE, [range(8)])
print(mesh.quality("q")[0], mesh.worst(1)[0])
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert (done.stdout, done.stderr) == ("1.0 0\n", "")
