"""What tests of the command line share."""

import pytest

from hexmend import gallery, io


@pytest.fixture
def mesh(tmp_path):
    path = tmp_path / "mesh.vtu"
    io.write(path, gallery.make("cube", size=125, scramble=0.3))
    return path
