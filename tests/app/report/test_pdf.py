"""PDF reports: page breaks and split tables."""

from __future__ import annotations

import pytest

from hexmend.report.tables import Table
from hexmend_app.report import html_elements as html
from hexmend_app.resources import resource

#: A table after its heading, each part with a mark by which it is found.
_TABLE = html.table(Table("The worst", ["hex", "q"], [[str(k), "0.5"] for k in range(8)]))
_MARKED = html.heading(3, "The worst hexes", id="heading") + _TABLE.replace("<caption", '<caption id="title"').replace(
    "<tbody><tr", '<tbody><tr id="row"'
)


@pytest.mark.slow
def test_a_heading_is_on_the_page_of_the_table_that_follows():
    weasyprint = pytest.importorskip("weasyprint")
    style = resource("report/page.css").read_text(encoding="utf-8")
    found = set()
    for tall in range(180, 264, 4):  # in mm; a page has room for 263
        page = f'<style>{style}</style><div style="height: {tall}mm"></div>{_MARKED}'
        pages = weasyprint.HTML(string=page).render().pages
        places = [next(k for k, one in enumerate(pages) if name in one.anchors) for name in ("heading", "title", "row")]
        assert len(set(places)) == 1, tall
        found.add(places[0])
    assert found == {0, 1}


def test_wide_tables_are_split():
    names = [f"method {k}" for k in range(16)]
    whole = Table("All", ["figure", *names], [["q min", *map(str, range(16))]], ["A note."])
    text = html.tables(whole)
    assert text.count("<table>") == 3
    assert all(text.count(f">{name}<") == 1 for name in names)
    assert (text.count(">q min<"), text.count("A note."), text.count("<caption>")) == (3, 1, 1)
