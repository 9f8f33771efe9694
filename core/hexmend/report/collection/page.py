"""The HTML page of a collection: tables that are sorted by a click on a head, and a small picture of each mesh."""

from __future__ import annotations

import base64
from collections.abc import Mapping
from html import escape
from pathlib import Path

from hexmend.report.collection.record import CollectionRecord
from hexmend.report.collection.tables import collection_tables, figures_table
from hexmend.report.documents import write_text
from hexmend.report.tables import Table

_STYLE = """
body { font: 14px/1.45 system-ui, sans-serif; margin: 24px; color: #1c1e21; background: #ffffff; }
h1 { font-size: 22px; } h2 { font-size: 17px; margin-top: 32px; }
p { max-width: 100ch; color: #4a4f55; }
div { overflow-x: auto; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
th, td { padding: 4px 6px; border-bottom: 1px solid #d9dce0; text-align: right; vertical-align: middle; }
th { position: sticky; top: 0; background: #f3f4f6; vertical-align: bottom; }
th button { font: inherit; font-weight: 600; text-align: inherit; color: inherit; background: none; border: 0;
  padding: 0; cursor: pointer; }
th[aria-sort=ascending] button::after { content: " \\25B2"; }
th[aria-sort=descending] button::after { content: " \\25BC"; }
th:first-child, td:first-child, .text { text-align: left; }
td.text { min-width: 30ch; }
td:first-child { white-space: nowrap; }
img { width: 80px; height: 60px; vertical-align: middle; margin-right: 8px; object-fit: contain; }
"""

#: Sorts the rows of a table by the column of a head: by number where a cell begins with one, else by text; cells
#: without a value come last.
_SCRIPT = """
for (const table of document.querySelectorAll("table")) {
  const heads = [...table.tHead.rows[0].cells], body = table.tBodies[0];
  const value = (row, k) => {
    const text = row.cells[k].textContent.trim();
    const number = parseFloat(text.replace(/,/g, "").replace("\u2212", "-"));
    return text === "" || text === "\u2013" ? null : isNaN(number) ? text.toLowerCase() : number;
  };
  const compare = (a, b) => typeof a === typeof b ? (a < b ? -1 : a > b ? 1 : 0) : typeof a === "number" ? -1 : 1;
  heads.forEach((head, k) => head.firstElementChild.addEventListener("click", () => {
    const sign = head.getAttribute("aria-sort") === "ascending" ? -1 : 1;
    heads.forEach(other => other.removeAttribute("aria-sort"));
    head.setAttribute("aria-sort", sign > 0 ? "ascending" : "descending");
    const rows = [...body.rows].map(row => [value(row, k), row]);
    rows.sort(([a], [b]) => a === null || b === null ? (a === null) - (b === null) : sign * compare(a, b));
    body.append(...rows.map(([, row]) => row));
  }));
}
"""


def write_page(path: Path, record: CollectionRecord, title: str) -> None:
    """Write the page; it needs neither network nor other files.

    Parameters
    ----------
    path : Path
    record : CollectionRecord
    title : str
    """
    pictures = {record.names[mesh]: picture for mesh, picture in record.pictures.items() if mesh in record.names}
    tables = [*collection_tables(record), figures_table(record)]
    parts = [_section(table, pictures if table.title == "Meshes" else {}) for table in tables]
    machine = "; ".join(f"{key} {value}" for key, value in record.machine.items())
    count = (
        f"{len(record.rows):,} of {record.tasks:,} results, each within {record.limit:g} s on one thread. {machine}."
    )
    head = f'<meta charset="utf-8"><title>{escape(title)}</title><style>{_STYLE}</style>'
    body = f"<h1>{escape(title)}</h1><p>{escape(count)}</p>{''.join(parts)}<script>{_SCRIPT}</script>"
    write_text(path, f'<!doctype html>\n<html lang="en"><head>{head}</head><body>{body}</body></html>\n')


def _section(table: Table, pictures: Mapping[str, bytes]) -> str:
    """Write a table with its title, notes, and pictures in the cells of the first column."""
    text = [_is_text(table, column) for column in range(len(table.head))]
    heads = "".join(f"<th{_class(text[k])}><button>{escape(head)}</button></th>" for k, head in enumerate(table.head))
    rows = "".join(
        "<tr>"
        + "".join(
            f"<td{_class(text[k])}>{_picture(pictures, cell) if k == 0 else ''}{escape(cell)}</td>"
            for k, cell in enumerate(line)
        )
        + "</tr>"
        for line in table.rows
    )
    notes = "".join(f"<p>{escape(note)}</p>" for note in table.notes)
    drawn = f"<div><table><thead><tr>{heads}</tr></thead><tbody>{rows}</tbody></table></div>"
    return f"<h2>{escape(table.title)}</h2>{drawn}{notes}"


def _is_text(table: Table, column: int) -> bool:
    """Return True for the last column, of remarks, and that of programs."""
    return table.head[column] in ("remark", "program", "worse with mend, fixed")


def _class(text: bool) -> str:
    return ' class="text"' if text else ""


def _picture(pictures: Mapping[str, bytes], name: str) -> str:
    if name not in pictures:
        return ""
    data = base64.b64encode(pictures[name]).decode("ascii")
    return f'<img alt="" loading="lazy" src="data:image/png;base64,{data}">'
