"""What is no method or metric is refused where it is announced, with what is missing."""

from dataclasses import dataclass

import pytest

from hexmend.quality import METRICS
from hexmend.quality import metric as metrics
from hexmend.smoothers import METHODS, Smoother, method
from hexmend.smoothers import base as smoother


def named(base=Smoother, **texts):
    """A class of methods that says of itself what it is given."""
    said = {"name": "toy", "title": "Toy", "help": "Does nothing.", "source": "none"} | texts
    return dataclass(frozen=True)(type("Toy", (base,), {key: text for key, text in said.items() if text is not None}))


@pytest.fixture(autouse=True)
def nothing_stays(monkeypatch):
    """Registries are as they were afterwards."""
    before = dict(METHODS), dict(METRICS)
    yield
    assert (dict(METHODS), dict(METRICS)) == before


def test_a_class_that_is_no_smoother_is_refused():
    with pytest.raises(TypeError, match=r"Toy is not a hexmend\.Smoother"):
        method(named(object))


@pytest.mark.parametrize("word", ["name", "title", "help", "source"])
@pytest.mark.parametrize("text", [None, 3])
def test_a_method_without_a_text_is_refused(word, text):
    with pytest.raises(TypeError, match=f"Toy has no {word}: expected a text"):
        method(named(**{word: text}))


@pytest.mark.parametrize("word", ["name", "title"])
def test_a_method_that_a_run_could_not_name_is_refused_when_it_is_made(word):
    nameless = named(**{word: None})
    nameless.__abstractmethods__ = frozenset()
    with pytest.raises(TypeError, match=f"Toy has no {word}: expected a text"):
        nameless()


def announce(monkeypatch, module, *found):
    """Let the entry points of a module's group hold these objects."""

    def load(group, kind, take):
        assert (group, kind) in [("hexmend.smoothers", "method"), ("hexmend.metrics", "metric")]
        for one in found:
            take("any", one)

    monkeypatch.setattr(module, "load_entry_points", load)
    module.load_plugins()


def test_what_is_no_metric_is_refused(monkeypatch):
    with pytest.raises(TypeError, match=r"3 is not a hexmend\.quality\.Metric"):
        announce(monkeypatch, metrics, 3)


def test_a_class_of_another_distribution_is_announced_once_and_other_objects_are_not(monkeypatch):
    added, new = [], named()
    monkeypatch.setattr(smoother, "method", added.append)
    announce(monkeypatch, smoother, METHODS["mend"], new, "no class", 3)
    assert added == [new]


def test_a_method_moves_free_nodes_and_slides_none_unless_it_says_so():
    from tests.core.grids import grid

    mesh, toy = grid(2), named()
    toy.__abstractmethods__ = frozenset()
    assert not toy().slides
    assert toy().movable(mesh).tolist() == mesh.free.tolist()
