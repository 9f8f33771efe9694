"""The texts of the window by feature, in reading order: print them, or write the catalogue for translators.

python scripts/list_texts.py [SECTION...]    print the texts, to be read in one go
python scripts/list_texts.py --write         write resources/translations/hexmend.pot

A section is a feature, another package of the app, or declarations of the core that the window shows.
"""

from __future__ import annotations

import ast
import sys
from collections.abc import Iterator, Mapping
from dataclasses import is_dataclass
from enum import StrEnum
from pathlib import Path
from typing import NamedTuple, TypeVar

from hexmend.iteration import Outcome
from hexmend.iteration.figures import DIAGNOSTICS, HISTORY
from hexmend.iteration.stopping import StoppingCriteria
from hexmend.parameters import declared
from hexmend.quality import METRICS, SUMMARY_QUANTITIES
from hexmend.report.charts import ChartStyle
from hexmend.report.comparison import LINES, ended
from hexmend.run.recipe_files import read_recipe
from hexmend.smoothers import METHODS
from hexmend_app.catalogue import quoted
from hexmend_app.codec.docstring_help import helps
from hexmend_app.codec.option import options_of
from hexmend_app.feature import MENUS, PanelGroup
from hexmend_app.features.compare.comparison_table import INITIAL
from hexmend_app.features.convergence.charts import CHARTS
from hexmend_app.picture import Scene
from hexmend_app.picture.colour_map import COLOUR_MAPS
from hexmend_app.picture.displacement import DISPLACEMENT_QUANTITIES
from hexmend_app.picture.layer_switch import LAYERS
from hexmend_app.picture.quantities import MATERIAL
from hexmend_app.resources import recipes
from hexmend_app.state.mesh.comparison_base import FILE_OPENED
from hexmend_app.state.mesh.hex_groups import GROUPS
from hexmend_app.state.node_step import StepStatus
from hexmend_app.state.view.side_views import NOW
from hexmend_app.translation import section_of
from hexmend_app.widgets.wording import name_in_words

Entry = TypeVar("Entry")

ROOT = Path(__file__).resolve().parents[1]
APP = ROOT / "app/hexmend_app"
CATALOGUE = ROOT / "resources/translations/hexmend.pot"

#: Sections in reading order, as a user meets them; those that are not listed follow.
ORDER = [
    "shell",
    "open",
    "save",
    "session",
    "figures",
    "film",
    "script",
    "edit",
    "doctor",
    "pad",
    "smooth",
    "recipe",
    "target_surface",
    "curves",
    "outcome",
    "timeline",
    "convergence",
    "runs",
    "node_step",
    "quality",
    "histogram",
    "hex_inspector",
    "tags",
    "measure",
    "appearance",
    "structure",
    "movement",
    "cut",
    "camera",
    "side_views",
    "compare",
    "console",
    "theme",
    "help",
    "canvas",
    "widgets",
]
#: Methods of the state whose first argument is the title of a change, which Undo shows.
_TITLED = {"commit", "_amend", "adopt_positions"}
#: Programs, whose texts are not those of the window.
_PROGRAMS = {"cli", "notebook", "report"}

HEADER = """\
# Texts of the window of Hexmend, a section for each feature, in the order in which a user meets them.
# Written by scripts/list_texts.py --write; do not edit. To translate: copy this file to the code of the language, such
# as de.po, fill in each msgstr, and try it with  hexmend view --language de.po  (docs/translating.md).
msgid ""
msgstr ""
"Content-Type: text/plain; charset=UTF-8\\n"
"Plural-Forms: nplurals=2; plural=(n != 1);\\n"
"X-Qt-Contexts: true\\n"
"""


class Text(NamedTuple):
    """Text with its plural, "" for a text without plural forms."""

    text: str
    plural: str = ""


class Module(NamedTuple):
    """Texts of a module, or of a group of declarations, with its description."""

    description: str
    texts: list[Text]


def sections() -> dict[str, list[Module]]:
    """Return the texts of all sections in reading order; a section has each text once."""
    found: dict[str, list[Module]] = {}
    for path in sorted(APP.rglob("*.py"), key=lambda path: (path.parent, path.name != "feature.py", path.name)):
        module = ".".join(("hexmend_app", *path.relative_to(APP).with_suffix("").parts))
        section = section_of(module)
        if section not in _PROGRAMS and (texts := list(texts_of(path))):
            found.setdefault(section, []).append(Module(_first_line(path), texts))
    order = {name: at for at, name in enumerate(ORDER)}
    found = dict(sorted(found.items(), key=lambda item: (order.get(item[0], len(order)), item[0])))
    found |= declarations()
    return {section: _once(modules) for section, modules in found.items()}


def _once(modules: list[Module]) -> list[Module]:
    """Return modules without texts of an earlier one."""
    seen: set[str] = set()
    kept = []
    for description, texts in modules:
        new = [text for text in dict.fromkeys(texts) if text.text.strip() and text.text not in seen]
        seen |= {text.text for text in new}
        if new:
            kept.append(Module(description, new))
    return kept


def texts_of(path: Path) -> Iterator[Text]:
    """Return the texts that a module shows, in order: those that it passes to `tr`, then those of its tables."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    constants = {
        target.id: statement.value
        for statement in tree.body
        if isinstance(statement, ast.Assign | ast.AnnAssign) and statement.value is not None
        for target in (statement.targets if isinstance(statement, ast.Assign) else [statement.target])
        if isinstance(target, ast.Name)
    }
    from_tables = False
    calls = [node for node in ast.walk(tree) if isinstance(node, ast.Call)]
    for node in sorted(calls, key=lambda node: (node.lineno, node.col_offset)):
        name = getattr(node.func, "id", "")
        if name in ("tr", "marked"):
            arguments = list(_literals(node.args[0], constants))
            from_tables = from_tables or not arguments
            yield from map(Text, arguments)
        elif name == "counted" and isinstance(node.args[1], ast.Constant):
            noun = node.args[1].value
            yield Text(f"{{number:,}} {noun}", f"{{number:,}} {noun}{'es' if noun.endswith('x') else 's'}")
        elif getattr(node.func, "attr", "") in _TITLED:
            yield from map(Text, _literals(node.args[0], constants))
        elif name == "tr_count" and all(isinstance(text, ast.Constant) for text in node.args[1:]):
            yield Text(*(text.value for text in node.args[1:]))
    if from_tables:
        for value in constants.values():
            yield from (Text(part.value) for part in ast.walk(value) if _is_text(part))


def _literals(node: ast.expr, constants: dict[str, ast.expr]) -> Iterator[str]:
    """Return the texts that an argument of `tr` may be; none if they are in a table."""
    if isinstance(node, ast.Name):
        node = constants.get(node.id, node)
    if isinstance(node, ast.IfExp):
        yield from _literals(node.body, constants)
        yield from _literals(node.orelse, constants)
    elif isinstance(node, ast.Constant) and isinstance(node.value, str):
        yield node.value


def _is_text(node: ast.AST) -> bool:
    """Return True for a literal that reads like a text: a capital first, or several words; not a path or a key."""
    if not isinstance(node, ast.Constant) or not isinstance(node.value, str):
        return False
    text = node.value.lstrip("&")
    return len(text) > 1 and (text[0].isupper() or " " in text)


def _first_line(path: Path) -> str:
    return (ast.get_docstring(ast.parse(path.read_text(encoding="utf-8"))) or "").partition("\n")[0]


def declarations() -> dict[str, list[Module]]:
    """Return the texts that are declared once, in the core or the app, and shown by several features."""
    quantities = {**SUMMARY_QUANTITIES, **HISTORY, **DIAGNOSTICS, **{line.key: line for line in LINES}}.values()
    return {
        "menus": [
            Module("Menus", _texts(*(menu.rpartition("/")[2] for menu in MENUS))),
            Module("Groups of panels", _texts(*(group.value for group in PanelGroup))),
        ],
        "pictures": [
            *(Module(f"Table {one.name} of a scene", _texts(*_keys(one.kind))) for one in options_of(Scene)),
            Module("Style of charts", _texts(*_parameters(ChartStyle))),
        ],
        "layers": [
            Module(f"Layer {one.name}", _texts(one.title, one.help, one.empty, one.action, one.action_help))
            for one in by_name(LAYERS)
        ],
        "methods": [
            *(Module(f"Method {one.name}", _texts(one.title, one.help, *_parameters(one))) for one in by_name(METHODS)),
            Module("Limits of a run", _texts(*_parameters(StoppingCriteria))),
            Module("Recipes", _texts(*(read_recipe(path).title for path in recipes()))),
        ],
        "metrics": [
            Module(
                f"Metric {one.name}", _texts(one.title, getattr(one, "label", ""), one.formula, one.meaning, one.unit)
            )
            for one in (*by_name(METRICS), *DISPLACEMENT_QUANTITIES.values(), MATERIAL)
        ],
        "colour maps": [Module(f"Colour map {one.name}", _texts(one.title, one.help)) for one in by_name(COLOUR_MAPS)],
        "quantities": [Module(f"Quantity {one.key}", _texts(one.title, one.label, one.help)) for one in quantities],
        "charts": [Module(f"Chart {one.key}", _texts(one.title, one.help)) for one in CHARTS.values()],
        "states": [
            Module("Groups of hexes", _texts(*GROUPS)),
            Module("Outcomes of a run", _texts(*(ended(outcome.key) for outcome in Outcome))),
            Module("Outcomes of the step of a node", _texts(*_step_outcomes())),
            Module("States of the mesh", _texts(FILE_OPENED, "as opened", INITIAL, NOW)),
        ],
    }


def _parameters(of: type) -> Iterator[str]:
    for one in declared(of):
        yield from (one.label or name_in_words(one.name), one.help, one.unit, *one.titles, one.percent_of)
        if not one.titles:
            yield from map(name_in_words, one.choices or ())


def by_name(registry: Mapping[str, Entry]) -> list[Entry]:
    """Return the entries of a registry sorted by name: their order depends on what is imported first."""
    return [registry[name] for name in sorted(registry)]


def _keys(table: type) -> Iterator[str]:
    """Return the titles, units and helps of the keys of a table of a scene."""
    if not is_dataclass(table):
        return
    for one in options_of(table):
        yield from (name_in_words(one.name), one.unit, helps(table).get(one.field, ""))
        if isinstance(one.kind, type) and issubclass(one.kind, StrEnum):
            yield from map(name_in_words, one.kind)


def _step_outcomes() -> Iterator[str]:
    for status in StepStatus:
        yield from dict.fromkeys((status.value, status.value.replace("Moved", "Will be moved")))


def _texts(*texts: str) -> list[Text]:
    return [Text(text) for text in texts if text]


def catalogue() -> str:
    """Return the catalogue as the text of its file."""
    lines = [HEADER]
    for section, modules in sections().items():
        lines.append(f"\n# {'=' * 20} {section} {'=' * 20}\n")
        for description, texts in modules:
            comment = f"#. {description}\n"
            for text, plural in texts:
                forms = 'msgstr[0] ""\nmsgstr[1] ""' if plural else 'msgstr ""'
                plural = f"msgid_plural {quoted(plural)}\n" if plural else ""
                lines.append(f'{comment}msgctxt "{section}"\nmsgid {quoted(text)}\n{plural}{forms}\n')
                comment = ""
    return "\n".join(lines)


def main(words: list[str]) -> None:
    """Print the texts of some sections, or of all; or write the catalogue."""
    if words == ["--write"]:
        CATALOGUE.write_text(catalogue(), encoding="utf-8")
        return
    for section, modules in sections().items():
        if not words or section in words:
            print(f"\n{section}")
            for description, texts in modules:
                print(f"  {description}")
                print(*(f"    {' / '.join(filter(None, text))}" for text in texts), sep="\n")


if __name__ == "__main__":
    main(sys.argv[1:])
