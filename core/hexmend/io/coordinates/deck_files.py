"""Decks of several files, and their replacement by files with other coordinates."""

from __future__ import annotations

import os
import shutil
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass
from itertools import count
from pathlib import Path, PurePosixPath

import numpy as np

from hexmend.errors import FileError
from hexmend.io.base.cursor import quoted, read_text_bytes
from hexmend.io.coordinates.located import CoordinatesError
from hexmend.io.coordinates.replacement import IncludedFileError, is_same_file
from hexmend.io.coordinates.text_coordinates import Edits
from hexmend.io.storage.atomic import AtomicFiles
from hexmend.io.storage.readable import check_readable

#: Files that include each other, and all files of a deck.
_MAX_DEPTH, _MAX_FILES = 10, 1000
_NEWLINE = b"\n"


@dataclass(frozen=True, eq=False)
class Reference:
    """Name of an included file in the file that includes it.

    Parameters
    ----------
    parent : DeckFile
    begin, end : int
        Byte range of the name in the parent, with quotes if it has them.
    name : str
        The name without quotes, with / between folders.
    """

    parent: DeckFile
    begin: int
    end: int
    name: str


class DeckFile:
    """A file of a deck; a file that is included twice is two of them.

    Parameters
    ----------
    path : Path
    given : bytes
        Its content.
    reference : Reference or None
        None for the deck itself, whose path errors name.

    Attributes
    ----------
    data : bytes
        The content with lines that end in "\\n"; offsets are those of `given`.
    included : list of DeckFile
        Files that it includes.
    """

    def __init__(self, path: Path, given: bytes, reference: Reference | None = None):
        self.path, self.given, self.reference = path, given, reference
        self.data = given.replace(b"\r\n", b" \n").replace(b"\r", b"\n") if b"\r" in given else given
        self.included: list[DeckFile] = []

    def error(self, problem: str, remedy: str = "Correct the file.") -> FileError:
        """Make the error to raise."""
        return FileError(self.lineage()[-1].path, problem, remedy)

    def place(self, at: int) -> str:
        """Return the place of an offset, such as "line 12", or "line 3 of nodes.inp" in an included file."""
        line = f"line {self.data.count(_NEWLINE, 0, at) + 1}"
        return line if self.reference is None else f"{line} of {self.path.name}"

    def walk(self) -> Iterator[DeckFile]:
        """Iterate over the file and all files that it includes, included ones last."""
        yield self
        for one in self.included:
            yield from one.walk()

    def lineage(self) -> list[DeckFile]:
        """Return the file, the one that includes it, and so on up to the deck."""
        return [self, *(self.reference.parent.lineage() if self.reference else [])]

    def include(self, name: str, begin: int, end: int, card: str) -> DeckFile:
        """Open a file that this one includes.

        Parameters
        ----------
        name : str
            Without quotes.
        begin, end : int
            Byte range of the name.
        card : str
            What includes it, for errors, such as "INCLUDE in line 3".

        Raises
        ------
        FileError
            For a file that does not exist or cannot be read, or that includes itself.
        """
        root, parents = self.lineage()[-1], [one.path.resolve() for one in self.lineage()]
        place = f"{card} of {self.path.name} reads {quoted(name)}"
        folders = (root.path.parent, self.path.parent)
        names = dict.fromkeys([name, name.replace("\\", "/")])  # of Windows
        found = [(folder / one, one) for one in names for folder in folders if name and (folder / one).is_file()]
        if not found:
            problem, remedy = f"{place}, which does not exist in {folders[0].absolute()}", "Copy it there."
            raise FileError(root.path, problem, remedy)
        path, name = found[0]
        n_files = sum(1 for _ in root.walk())
        if path.resolve() in parents or len(parents) > _MAX_DEPTH or n_files > _MAX_FILES:
            raise FileError(root.path, f"{place}: files include each other without end", "Correct the file.")
        check_readable(path, "a file of a deck")
        self.included.append(DeckFile(path, read_text_bytes(path), Reference(self, begin, end, name)))
        return self.included[-1]


def write_files(
    root: DeckFile, edits: Mapping[DeckFile, Edits], target: Path, files: AtomicFiles, old: set[Path]
) -> tuple[str, ...]:
    """Write a deck and the files that it includes with other coordinates.

    Where the deck replaces itself, so do its files. Else a file with moved nodes is written next to the new deck with
    the name of that deck behind its own, which the new deck refers to; others are copied where they are missing.

    Parameters
    ----------
    root : DeckFile
    edits : mapping of DeckFile to Edits
        Of the deck and the files that it includes.
    target : Path
    files : AtomicFiles
        As of `LocatedCoordinates.write`.
    old : set of Path
        Files that the deck at the target includes.

    Returns
    -------
    tuple of str
        Notes about the files.

    Raises
    ------
    CoordinatesError
        If a file with moved nodes is included twice.
    IncludedFileError
        If the copy of the deck would include itself.
    """
    file = files.add(target)  # the first, which is replaced last
    own = {one: part for one, part in edits.items() if len(part)}
    paths = [one.path.resolve() for one in root.walk()]
    if twice := [one for one in own if paths.count(one.path.resolve()) > 1]:
        raise CoordinatesError(f"{twice[0].path.name} is included twice, and its nodes have moved")
    if is_same_file(root.path, target):
        for one, part in own.items():
            if one is not root:
                part.write(files.add(one.path), one.given)
        own.get(root, Edits()).write(file, root.given)
        changed = sorted(one.path.name for one in own if one is not root)
        return (f"Coordinates are replaced in {', '.join(changed)} too.",) if changed else ()
    renamed = _new_names(root, own, target, old)
    notes = []
    for one in reversed(list(root.walk())[1:]):  # included files before those that include them
        if one in renamed:
            part = _with_names(own.get(one, Edits()), _references(one, renamed))
            part.write(files.add(_place(target, renamed[one])), one.given)
            notes.append(f"{one.reference.name} is written as {renamed[one]}.")
        else:
            notes += _copied(one, renamed, target, files)
    _with_names(own.get(root, Edits()), _references(root, renamed)).write(file, root.given)
    return tuple(dict.fromkeys(reversed(notes)))


def _references(file: DeckFile, renamed: dict[DeckFile, str]) -> list[tuple[Reference, str]]:
    """Places in a file that name files with another name in the copy, and these names."""
    return [(one.reference, renamed[one]) for one in file.included if one in renamed]


def _with_names(edits: Edits, names: list[tuple[Reference, str]]) -> Edits:
    """Edits and the new names of included files."""
    parts = [edits]
    for reference, name in names:
        first = reference.parent.given[reference.begin : reference.begin + 1]
        quote = first if first in (b'"', b"'") else b""
        place = np.array([reference.begin]), np.array([reference.end])
        parts.append(Edits(*place, [quote + name.encode() + quote]))
    begin, end = (np.concatenate([getattr(part, name) for part in parts]) for name in ("begin", "end"))
    return Edits(begin, end, [text for part in parts for text in part.texts]).in_order()


def _new_names(root: DeckFile, own: Collection[DeckFile], target: Path, old: set[Path]) -> dict[DeckFile, str]:
    """Names of the copies of included files with moved nodes, and of files that include them.

    No other file has the name, save one in `old`, those of the deck at the target, which these copies replace.
    """
    given = {one.path.resolve() for one in root.walk()}
    free, renamed = old - given, {}
    taken = {target.resolve()}
    for one in list(root.walk())[1:]:
        if not any(file in own for file in one.walk()):
            continue
        for number in count(1):
            name = _renamed(one, f"-{target.stem}" if number == 1 else f"-{target.stem}-{number}")
            path = (target.parent / name).resolve()
            if path not in taken and (path in free or not os.path.lexists(path)):
                break
        taken.add(path)
        renamed[one] = name
    return renamed


def _renamed(file: DeckFile, suffix: str) -> str:
    """Name of the copy of an included file, with letters behind its own; a file elsewhere comes next to the deck."""
    name = PurePosixPath(file.reference.name)
    name = name.with_name(f"{name.stem}{suffix}{name.suffix}")
    return name.name if name.is_absolute() or ".." in name.parts else str(name)


def _place(target: Path, name: str) -> Path:
    """Path of a file next to the new deck, in a folder that exists."""
    path = target.parent / name
    path.parent.mkdir(parents=True, exist_ok=True)
    return path


def _copied(file: DeckFile, renamed: dict[DeckFile, str], target: Path, files: AtomicFiles) -> list[str]:
    """Copy an included file that stays as it is to where the new deck looks for it; returns notes.

    Raises `IncludedFileError` where the new deck has the name of this file: it would include itself.
    """
    name, parent = Path(file.reference.name), file.reference.parent
    folder = Path(renamed.get(parent, parent.reference.name if parent.reference else "")).parent
    if name.is_absolute():
        return []
    places = [target.parent / at / name for at in ("", folder)]
    if target.resolve() in [path.resolve() for path in places]:
        deck = file.reference.parent.path.name
        raise IncludedFileError(target, f"has the name of a file that {deck} includes", "Choose another name.")
    found = next((path for path in places if path.is_file()), None)
    if found is not None or ".." in name.parts:
        same = found is not None and (is_same_file(file.path, found) or found.read_bytes() == file.given)
        return [] if same else [f"The new deck includes {name}, which was not copied: check that it is the right file."]
    shutil.copyfile(file.path, files.add(_place(target, str(name))))
    return [f"{name} is copied next to the new deck."]
