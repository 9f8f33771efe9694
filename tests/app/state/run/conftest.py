"""Document with a small mesh, for tests of runs on it."""

from pathlib import Path

import pytest

from hexmend_app.state.mesh.document import Document, MeasuredMesh
from tests.core.grids import grid, scrambled


@pytest.fixture
def document(qtbot):
    document = Document()
    document.replace(MeasuredMesh.of(scrambled(grid(6), 0.4)), Path("a.vtu"))
    return document
