"""What is written under a suffix that it cannot have is refused with those that it can."""

import pytest

from hexmend.errors import FileError
from hexmend.io.storage.suffixes import suffix_for
from hexmend.report.charts import check_figure
from hexmend.run import StoppingCriteria
from hexmend.run.recipe import Recipe, Stage
from hexmend.run.recipe_files import write_recipe
from hexmend.smoothers import METHODS


@pytest.mark.parametrize("name", ["a.csv", "a.CSV", "b.md", "c.d.md"])
def test_a_suffix_that_there_is_is_told_in_small_letters(name):
    assert suffix_for(name, "a table", [".csv", ".md"]) == f".{name.rpartition('.')[2].lower()}"


def test_no_suffix_is_admitted_only_where_it_is_named():
    assert suffix_for("/dev/stdout", "a table", [".csv", ""]) == ""
    with pytest.raises(FileError, match=r"as a file without a suffix. Use \.csv\.$"):
        suffix_for("table", "a table", [".csv"])


def test_writers_refuse_other_suffixes_and_leave_no_file(tmp_path):
    method = next(iter(METHODS.values()))
    with pytest.raises(FileError, match=r"Use \.toml\.$"):
        write_recipe(tmp_path / "a.yaml", Recipe.of(Stage(method(), StoppingCriteria())))
    with pytest.raises(FileError, match=r"Use \.svg, \.pdf or \.png\.$"):
        check_figure(tmp_path / "a.gif")
    assert list(tmp_path.iterdir()) == []
