"""What methods advise where something got worse, and what mend's steps say while another stage is to come."""

import itertools

import pytest

from hexmend.quality.regressions import REGRESSION_KEYS
from hexmend.smoothers import METHODS

#: Every set of figures that can be worse.
WORSE = [words for count in range(len(REGRESSION_KEYS) + 1) for words in itertools.combinations(REGRESSION_KEYS, count)]


@pytest.mark.parametrize("name", METHODS)
def test_what_is_advised_is_a_text_whatever_got_worse(name):
    assert all(isinstance(METHODS[name]().regression_hint(words), str) for words in WORSE)


def test_mend_advises_the_goal_by_which_nothing_falls_only_where_it_helps():
    mend = METHODS["mend"]
    for words in WORSE:
        advice = mend(goal="shape").regression_hint(words)
        valid = not {"inverted", "invalid"} & set(words)
        assert ("goal=balanced" in advice) == (bool(words) and valid)
        assert mend(goal="scaled-jacobian").regression_hint(words) == mend().regression_hint(words) == ""
