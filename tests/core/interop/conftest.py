"""What the tests of conversions share."""

import sys

import pytest


@pytest.fixture
def absent(monkeypatch):
    """A function that lets a library be absent: to import it fails as where it is not installed."""
    return lambda library: monkeypatch.setitem(sys.modules, library, None)
