"""A session whose actions are recorded in a script."""

import pytest

from hexmend import io
from hexmend.gallery import make
from hexmend_app.features.script.script import Script
from hexmend_app.state.session.session import Session
from tests.app.features.script.recording import opened


@pytest.fixture
def path(tmp_path):
    path = tmp_path / "it's a bridge.vtu"
    io.write(path, make("bridge-sharp", size=1000, scramble=0.4, seed=1))
    return path


@pytest.fixture
def session(qtbot, path):
    session = Session()
    session.script = Script(session, session)
    opened(qtbot, session, path)
    yield session
    session.close()
