"""The letters by which the entries of a menu are reached with Alt, each its own: features do not know each other's."""

from __future__ import annotations

from collections.abc import Iterator, Sequence


def letter_of(text: str) -> str:
    """The letter behind a text's ampersand, lower case; "" where there is none.

    >>> letter_of("R&un"), letter_of("Run")
    ('u', '')
    """
    return text.partition("&")[2][:1].lower()


def letters(texts: Sequence[str]) -> list[str]:
    """A letter for each of a menu's texts, lower case; "" where all of its are taken.

    What stands behind an ampersand is given first, to the first that has it there; then words' first letters, then
    any others.

    Parameters
    ----------
    texts : sequence of str

    >>> letters(["Open &recent", "&Run", "R&eset", "Cut", "Compare", "Cu"])
    ['r', 'u', 'e', 'c', 'o', '']
    """
    given: dict[int, str] = {}
    for at, text in enumerate(texts):
        wanted = letter_of(text)
        if wanted and wanted not in given.values():
            given[at] = wanted
    for at, text in enumerate(texts):
        if at not in given:
            given[at] = next((one for one in _offered(text) if one not in given.values()), "")
    return [given[at] for at in range(len(texts))]


def marked(text: str, letter: str) -> str:
    """A text with an ampersand before a letter: where it has one already if that is the letter, else at a word's start.

    >>> marked("R&un", "u"), marked("Run the recipe", "r"), marked("&Iteration on", "n"), marked("Run", "")
    ('R&un', '&Run the recipe', 'Iteratio&n on', 'Run')
    """
    if letter_of(text) == letter:
        return text
    text = text.replace("&", "")
    starts = [at for at, one in enumerate(text) if one.lower() == letter]
    at = min(starts, key=lambda at: (not _begins(text, at), at), default=None)
    return text if at is None else f"{text[:at]}&{text[at:]}"


def _begins(text: str, at: int) -> bool:
    return at == 0 or not text[at - 1].isalnum()


def _offered(text: str) -> Iterator[str]:
    plain = text.replace("&", "")
    initials = [one for at, one in enumerate(plain) if _begins(plain, at)]
    yield from (one.lower() for one in (*initials, *plain) if one.isalnum())
