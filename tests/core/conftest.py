"""What tests of the core share."""

from collections.abc import Callable
from pathlib import Path

import pytest

from hexmend import Mesh, read
from hexmend.gallery import GALLERY, make


@pytest.fixture(scope="session")
def sample_mesh(real_mesh: Callable[[str], Path]) -> Callable[[str], Mesh]:
    """A mesh of the gallery by its name, or a published one by its file; the test is skipped where that is absent."""

    def find(name: str, **options: float) -> Mesh:
        return make(name, **options) if name in GALLERY else read(real_mesh(name))

    return find
