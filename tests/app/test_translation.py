"""Translation of the window: with a catalogue that translates every text, no English word is seen."""

import importlib.util
import re
from html import escape

import pytest
from PySide6.QtCore import QCoreApplication, Qt
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QComboBox, QTabBar, QTableView, QTreeView, QWidget

from hexmend.doctor import PROBLEMS
from hexmend.errors import FileError, ParameterError
from hexmend.iteration import Outcome
from hexmend.parameters import declared
from hexmend.quality import METRICS
from hexmend.run import StoppingCriteria
from hexmend.smoothers import METHODS
from hexmend_app.catalogue import Translation, quoted, read_catalogue
from hexmend_app.picture.appearance import Since
from hexmend_app.picture.colour_map import COLOUR_MAPS
from hexmend_app.picture.displacement import DISPLACEMENT_QUANTITIES
from hexmend_app.resources import recipes
from hexmend_app.shell.start import language
from hexmend_app.shell.start.language import install_language
from hexmend_app.state.tasks.task import running
from hexmend_app.translation import PREFIX, tr, tr_count
from tests.app.conftest import close, separate_settings, window_with_mesh
from tests.app.dialogs import DIALOGS
from tests.app.driving import choose, turn
from tests.examples import ROOT
from tests.patience import PATIENCE

spec = importlib.util.spec_from_file_location("list_texts", ROOT / "scripts/list_texts.py")
list_texts = importlib.util.module_from_spec(spec)
spec.loader.exec_module(list_texts)

GETTERS = ("text", "title", "toolTip", "statusTip", "whatsThis", "accessibleName", "accessibleDescription",
           "placeholderText", "suffix", "windowTitle", "prefix")  # fmt: skip
ROLES = Qt.ItemDataRole.DisplayRole, Qt.ItemDataRole.ToolTipRole
#: Tags, entities and fields of a text, which a translation keeps.
KEPT = re.compile(r"(<[^>]*>|&\w+;|\{[^}]*\}|\n)")
ACCENTS = str.maketrans("aeiouyAEIOUY", "àèìòùÿÀÈÌÒÙŸ")
WORD = re.compile(r"[^\W\d_]+")
#: Words that are the same in every language: names of the program and of formats, units, and keys as Qt names them.
SAME = {
    "bytes",
    "kib",
    "white",
    "transparent",
    "hexmend",
    "vtu",
    "vtk",
    "csv",
    "png",
    "svg",
    "pdf",
    "tiff",
    "tif",
    "gif",
    "html",
    "toml",
    "json",
    "mib",
    "gib",
    "mean",
    "std",
    "dpi",
    "ctrl",
    "shift",
    "alt",
    "esc",
    "del",
    "return",
    "backspace",
    "right",
    "left",
    "home",
    "end",
    "tab",
    "space",
    "plus",
    "minus",
    "pgup",
    "pgdown",
    "enter",
    "full",
    "hd",
    "python",
    "gmsh",
    "abaqus",
}


def pseudo(text):
    """Translate a text: accents on all vowels, in brackets, and 30 % longer."""
    parts = [part if KEPT.fullmatch(part) else part.translate(ACCENTS) for part in KEPT.split(text)]
    end = "·" * round(0.3 * len(text))
    return "[" + "".join(parts) + end + "]" if text.strip() else text


def pseudo_catalogue(path):
    """Write the translation of the whole catalogue into a file and return its path."""
    lines = ['msgid ""', 'msgstr "Plural-Forms: nplurals=2; plural=(n != 1);\\n"', ""]
    for entry in read_catalogue(list_texts.CATALOGUE)[1]:
        lines += [f"msgctxt {quoted(entry.section)}", f"msgid {quoted(entry.text)}"]
        if entry.plural:
            one, several = quoted(pseudo(entry.text)), quoted(pseudo(entry.plural))
            lines += [f"msgid_plural {quoted(entry.plural)}", f"msgstr[0] {one}", f"msgstr[1] {several}", ""]
        else:
            lines += [f"msgstr {quoted(pseudo(entry.text))}", ""]
    path.write_text("\n".join(lines), encoding="utf-8")
    return path


class Recording(Translation):
    """Translation that records the texts for which the program asks in vain."""

    def __init__(self, path):
        super().__init__(path)
        self.missing = set()

    def translate(self, context, text, *rest):
        if not context.startswith(PREFIX):
            return pseudo(text)  # Qt and pyqtgraph have catalogues of their own
        found = super().translate(context, text, *rest)
        if not found and len(text) > 1 and "[" not in text:
            self.missing.add(text)
        return found


@pytest.fixture
def catalogue_file(tmp_path):
    return pseudo_catalogue(tmp_path / "xx.po")


@pytest.fixture
def translation(qapp, catalogue_file):
    translation = Recording(catalogue_file)
    QCoreApplication.installTranslator(translation)
    yield translation
    QCoreApplication.removeTranslator(translation)


@pytest.fixture
def translated_window(translation, qtbot, mesh_file, tmp_path):
    with separate_settings(tmp_path / "settings"):
        window = window_with_mesh(qtbot, mesh_file)
        yield window
        close(window)


def texts_of(part):
    """Return the texts that a widget or an action shows."""
    for name in GETTERS:
        if part.metaObject().indexOfProperty(name) >= 0:
            yield part.property(name) or ""
    if isinstance(part, QComboBox):
        yield from (part.itemText(at) for at in range(part.count()))
        yield from (str(part.itemData(at, Qt.ItemDataRole.ToolTipRole) or "") for at in range(part.count()))
    if isinstance(part, QTabBar):
        yield from (part.tabText(at) for at in range(part.count()))
        yield from (part.tabToolTip(at) for at in range(part.count()))
    if isinstance(part, QTableView | QTreeView) and (model := part.model()) is not None:
        for column in range(model.columnCount()):
            for role in ROLES:
                yield str(model.headerData(column, Qt.Orientation.Horizontal, role) or "")
                yield from (str(model.index(row, column).data(role) or "") for row in range(min(model.rowCount(), 30)))


def english(text, known):
    """Return the English words of a text: those without accents, apart from known ones."""
    text = re.sub(r"<[^>]*>|&\w+;", " ", text)
    text = re.sub(r"[^\s(]*/[^\s,)]*", " ", text).replace("&", "")  # without paths
    words = WORD.findall(text)
    return [word for word in words if len(word) > 2 and word.isascii() and re.search("[aeiou]", word.lower())
            and word.lower() not in known]  # fmt: skip


def known_words(window):
    """Return the words that stay English: names as typed in commands, literature, and data of the mesh."""
    document = window.session.document
    names = {*SAME, *METHODS, *COLOUR_MAPS, *METRICS, *document.now.mesh.node_sets, str(document.path), "tagged"}
    names |= {one.source for one in METRICS.values()}
    for method in METHODS.values():
        names.add(method.source)
        for parameter in declared(method):
            names |= {parameter.name, parameter.automatic, parameter.no_limit, *parameter.suggestions}
            names |= set(parameter.choices or ())
    names |= {path.name for path in recipes()} | {
        name for one in declared(StoppingCriteria) for name in one.choices or ()
    }
    return {word.lower() for name in names for word in WORD.findall(str(name))}


def sentences_of_core(window):
    """Return the sentences that the core has composed about the mesh and its runs, which are English; longest first."""
    session = window.session
    sentences = [*session.document.now.mesh.notes, *(outcome.value.rstrip(".") for outcome in Outcome)]
    for record in session.history.records:
        sentences += [record.message, record.name]
        if record.advice is not None:
            parts = [record.advice, *record.advice.suggestions]
            sentences += [value for part in parts for value in vars(part).values() if isinstance(value, str)]
    for finding in session.mesh_checker.of(session.document.start.mesh) or ():
        sentences += [finding.message, finding.remedy, PROBLEMS[finding.kind].title]
    sentences += [result.row.message for result in session.comparison.results]
    displacement = session.comparison_bases.displacement(Since.OPENED)
    sentences += [displacement.title(name) for name in DISPLACEMENT_QUANTITIES]
    return sorted((one for one in sentences if one), key=len, reverse=True)


def escapes(window, parts):
    """Return the texts of widgets and actions with English words, with these."""
    known, sentences = known_words(window), sentences_of_core(window)
    found = {}
    for text in {text for part in parts for text in texts_of(part)}:
        rest = text
        for sentence in sentences:
            rest = rest.replace(sentence, "").replace(escape(sentence), "")
        if words := english(rest, known):
            found[text] = words
    return found


def all_parts(window):
    return [window, *window.findChildren(QWidget), *window.findChildren(QAction)]


def check(window, translation, parts, name):
    """Check the texts of widgets; `name` says in which state of the window."""
    assert (name, escapes(window, parts)) == (name, {})
    assert (name, translation.missing - set(sentences_of_core(window))) == (name, set())


def wait_for_tasks(window, qtbot):
    """Wait until the window shows what is computed in the background."""
    qtbot.waitUntil(lambda: running() == (), timeout=PATIENCE)
    turn()
    window.refresh()


def use(window, qtbot):
    """Yield names of states of the window, after bringing it into each of them."""
    session = window.session
    yield "at the start"
    window.features["doctor"].refresh()
    for id in window.docks.ids():
        window.show_panel(id)
    window.refresh()
    wait_for_tasks(window, qtbot)
    yield "all panels were shown"
    worst = int(session.selection.worst_hexes()[0])
    session.selection.choose(worst, int(session.document.now.mesh.hexes[worst][0]))
    session.view.isolate((worst,))
    session.view.change(show={"metric": "q", "quality": (0.2, 0.9)})
    window.refresh()
    yield "a hex is isolated"
    session.view.show_all()
    window.features["curves"].refresh()
    choose(window, "local-sd", StoppingCriteria(max_iterations=2))
    window.action("run").trigger()
    qtbot.waitUntil(lambda: not session.run.busy, timeout=PATIENCE)
    window.refresh()
    wait_for_tasks(window, qtbot)
    yield "after a run"
    session.commands.tag("tagged", [worst])
    session.commands.pin(int(session.document.now.mesh.hexes[worst][1]), True)
    session.view.colour_by("q-change")
    window.refresh()
    yield "after tagging"
    window.action("undo").trigger()
    window.refresh()
    yield "after undoing"
    session.view.start_measuring()
    for point in session.document.now.mesh.points[:3]:
        session.view.measure(tuple(point.tolist()))
    window.refresh()
    yield "measuring"
    session.view.end_measuring()
    session.comparison.start([METHODS["laplacian"]()], StoppingCriteria(max_iterations=2))
    qtbot.waitUntil(lambda: not session.comparison.busy, timeout=PATIENCE)
    session.side_views.show(tr("earlier mesh"), session.document.start)
    window.refresh()
    yield "after comparing"


def test_every_text_of_the_window_is_translated(translated_window, translation, qtbot):
    window = translated_window
    assert sum("[" in text for part in all_parts(window) for text in texts_of(part)) > 1000
    for name in use(window, qtbot):
        check(window, translation, all_parts(window), name)


@pytest.mark.parametrize("name", DIALOGS)
def test_every_text_of_a_dialog_is_translated(translated_window, translation, name):
    if name == "waiting":
        pytest.skip("its texts are given")
    dialog = DIALOGS[name](translated_window)
    check(translated_window, translation, [dialog, *dialog.findChildren(QWidget)], name)
    dialog.deleteLater()


def test_a_translated_window_fits_a_small_screen(translated_window):
    assert translated_window.minimumSizeHint().width() <= 1366


def test_english_words_are_found():
    assert english("Pause áftér [this]", {"this"}) == ["Pause"]
    assert english(pseudo("Pause <b>after</b> {count:,} &amp; iterations"), {"count"}) == []


def test_the_catalogue_is_up_to_date():
    """After a change of texts: python scripts/list_texts.py --write."""
    assert list_texts.CATALOGUE.read_text(encoding="utf-8") == list_texts.catalogue()


def test_a_section_is_a_feature_and_has_a_text_once():
    _, entries = read_catalogue(list_texts.CATALOGUE)
    names = [(entry.section, entry.text) for entry in entries]
    assert len(names) == len(set(names))
    features = {path.parent.name for path in (ROOT / "app/hexmend_app/features").glob("*/feature.py")}
    assert features <= {entry.section for entry in entries}
    assert len(entries) > 1500


PO = """msgid ""
msgstr "Plural-Forms: nplurals=3; plural=(n==1 ? 0 : n<5 ? 1 : 2);\\n"

# a comment
msgctxt "cut"
msgid "Position"
msgstr "Lage"

msgctxt "save"
msgid "Position"
msgstr "Stelle"

msgctxt "cut"
msgid "{count:,} hidden"
msgstr "{count:,} ver"
"steckt"

msgctxt "cut"
msgid "{a} of {b}"
msgstr "{a} von {c}"

msgctxt "cut"
msgid "Flip"
msgstr ""

msgctxt "widgets"
msgid "{number:,} node"
msgid_plural "{number:,} nodes"
msgstr[0] "{number:,} Knoten (eins)"
msgstr[1] "{number:,} Knoten (wenige)"
msgstr[2] "{number:,} Knoten (viele)"
"""


@pytest.fixture
def german(tmp_path):
    path = tmp_path / "de.po"
    path.write_text(PO, encoding="utf-8")
    return path


def test_a_text_has_the_translation_of_its_section_and_else_of_another(german, caplog):
    translation = Translation(german)
    assert translation.translate(PREFIX + "cut", "Position") == "Lage"
    assert translation.translate(PREFIX + "save", "Position") == "Stelle"
    assert translation.translate(PREFIX + "smooth", "Position") == "Lage"
    assert translation.translate(PREFIX + "smooth", "{count:,} hidden") == "{count:,} versteckt"
    assert translation.translate(PREFIX + "cut", "Flip") is None
    assert translation.translate("QDialogButtonBox", "Position") is None
    assert translation.translate(PREFIX + "cut", "{a} of {b}") is None
    assert "de.po: the translation in line 18 is ignored: its field {c} is not in the English text" in caplog.text


def test_plural_forms_are_those_of_the_language(german, qapp):
    translation = Translation(german)
    QCoreApplication.installTranslator(translation)
    try:
        texts = [tr_count(n, "{number:,} node", "{number:,} nodes") for n in (1, 2, 1234)]
        assert tr("Flip") == "Flip"
    finally:
        QCoreApplication.removeTranslator(translation)
    assert texts == ["1 Knoten (eins)", "2 Knoten (wenige)", "1,234 Knoten (viele)"]


#: Catalogues as some editors write them: with a byte order mark, without empty lines, with entries to be checked.
UNUSUAL = r"""msgid ""
msgstr "Plural-Forms: nplurals=2; plural=n>1\n"
msgctxt "cut"
msgid "Run"
msgstr "Lauf \x\"\u12\n"
msgid "Stop"
msgstr "Halt"
#, fuzzy, python-brace-format
msgid "Flip"
msgstr "Flop"
#, fuzzy
#~ msgid "Old"
#~ msgstr "Alt"

msgid "Undo"
msgstr "Zurück"
msgid "Redo"
msgid_plural "Redos"
msgstr[0] "0 und 1"
msgstr[1] "mehr"
msgid "{count:,} of {name}"
msgstr "{count:d} von {name}"
msgid "{a}"
msgstr "{a:{a}}"

msgid "Save"
"""


def test_unusual_and_damaged_entries_do_no_harm(tmp_path, caplog):
    path = tmp_path / "de.po"
    path.write_text(UNUSUAL, encoding="utf-8-sig")
    translation = Translation(path)
    texts = {text: translation.translate(PREFIX + "cut", text) for text in ("Run", "Stop", "Undo")}
    assert texts == {"Run": 'Lauf x"u12\n', "Stop": "Halt", "Undo": "Zurück"}
    assert [translation.translate(PREFIX + "cut", "Redos", None, n) for n in (0, 1, 2)] == [
        "0 und 1",
        "0 und 1",
        "mehr",
    ]
    for text in ("Flip", "Old", "Save", "{count:,} of {name}", "{a}"):
        assert translation.translate(PREFIX + "cut", text) is None
    assert "its field {count:d} is not in the English text" in caplog.text


@pytest.mark.parametrize(("content", "problem"), [
    ("msgid Run\n", "line 1 is 'msgid Run': expected msgctxt, msgid or msgstr with a text in quotes"),
    ('"Run"\n', "line 1"),
    ('msgid ""\nmsgstr "Plural-Forms: nplurals=2; plural=(n ? ;\\n"\n', "Plural-Forms"),
])  # fmt: skip
def test_a_damaged_catalogue_is_refused(tmp_path, content, problem):
    path = tmp_path / "de.po"
    path.write_text(content, encoding="utf-8")
    with pytest.raises(FileError) as error:
        Translation(path)
    assert problem in str(error.value)


def test_a_catalogue_that_cannot_be_read_is_refused(tmp_path):
    path = tmp_path / "de.po"
    with pytest.raises(FileError, match=r"de\.po: cannot be read: No such file or directory"):
        Translation(path)
    path.write_bytes(b'msgid "\xe4"\n')
    with pytest.raises(FileError, match=r"is not text in UTF-8: .* at byte 7"):
        Translation(path)


def test_the_language_of_the_system_is_used_if_there_is_a_catalogue(german, monkeypatch, qapp):
    installed = []
    monkeypatch.setattr(language, "languages", lambda: {"de": german})
    monkeypatch.setattr(type(qapp), "installTranslator", lambda app, translation: installed.append(translation))
    for codes, expected in ((["de-DE", "de", "en"], 1), (["en-GB", "de"], 0), (["fr-FR", "fr"], 0), (["C"], 0)):
        installed.clear()
        monkeypatch.setattr(language, "system_languages", lambda codes=codes: codes)
        install_language(qapp)
        assert sum(isinstance(one, Translation) for one in installed) == expected


def test_a_damaged_catalogue_of_the_language_of_the_system_leaves_the_window_in_english(
    tmp_path, monkeypatch, qapp, caplog
):
    path = tmp_path / "de.po"
    path.write_text("msgid Run\n", encoding="utf-8")
    installed = []
    monkeypatch.setattr(language, "languages", lambda: {"de": path})
    monkeypatch.setattr(language, "system_languages", lambda: ["de"])
    monkeypatch.setattr(type(qapp), "installTranslator", lambda app, translation: installed.append(translation))
    install_language(qapp)
    assert "The window is in English" in caplog.text
    assert "de.po" in caplog.text
    with pytest.raises(FileError, match="line 1"):
        install_language(qapp, "de")
    assert installed == []


def test_an_installation_without_translations_is_english(monkeypatch, qapp):
    def missing(name):
        raise FileNotFoundError(name)

    monkeypatch.setattr(language, "resource", missing)
    monkeypatch.setattr(language, "system_languages", lambda: ["de"])
    install_language(qapp)
    assert language.languages() == {}


def test_a_language_without_a_catalogue_is_refused(qapp):
    with pytest.raises(ParameterError, match="there is no translation 'xx': expected en"):
        install_language(qapp, "xx")
