"""Missing graphics libraries are reported with the package that contains them, without a crash."""

import sys

import pytest

from hexmend.io import write
from tests.core.grids import grid
from tests.programs import run_python

pytestmark = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="other systems include OpenGL")


def render(folder, **environment):
    write(folder / "mesh.vtu", grid(1))
    words = ["render", folder / "mesh.vtu", "-o", folder / "out.png"]
    return run_python("-m", "hexmend", *words, variables=environment)


def test_without_the_library(tmp_path):
    (tmp_path / "libEGL.so.1").write_text("not a library")
    done = render(tmp_path, LD_LIBRARY_PATH=str(tmp_path))
    assert done.returncode == 2
    assert done.stderr == "hexmend: pictures need OpenGL: run  apt-get install libegl1 libgl1-mesa-dri\n"
    assert not (tmp_path / "out.png").exists()


@pytest.mark.slow
def test_without_a_driver(tmp_path):
    done = render(tmp_path, __EGL_VENDOR_LIBRARY_FILENAMES=str(tmp_path / "none.json"))
    assert done.returncode == 2
    assert done.stderr == "hexmend: OpenGL finds no driver to draw with: run  apt-get install libgl1-mesa-dri\n"
    assert not (tmp_path / "out.png").exists()
