"""Mnemonics of menu entries, distinct in each menu: features do not know each other's."""

from __future__ import annotations

from collections.abc import Sequence


def letter_of(text: str) -> str:
    """The mnemonic of a text in lower case; "" without one.

    >>> letter_of("R&un"), letter_of("Run")
    ('u', '')
    """
    return text.partition("&")[2][:1].lower()


def letters(texts: Sequence[str]) -> list[str]:
    """Distinct mnemonics for the texts of a menu in lower case; "" where letters run out.

    What stands behind an ampersand is given to the first that has it there. The others have words' first letters as
    far as these go, then any of theirs.

    Parameters
    ----------
    texts : sequence of str

    >>> letters(["Open &recent", "&Run", "Cut", "Compare", "Cu"])
    ['r', 'u', 't', 'o', 'c']
    """
    holders: dict[str, int] = {}
    for at, text in enumerate(texts):
        holders.setdefault(letter_of(text), at)
    holders.pop("", None)
    named = set(holders.values())
    for at in range(len(texts)):
        if at not in named:
            _give(at, texts, holders, {letter_of(texts[one]) for one in named})
    assigned = {at: letter for letter, at in holders.items()}
    return [assigned.get(at, "") for at in range(len(texts))]


def marked(text: str, letter: str) -> str:
    """A text with an ampersand before a letter, preferably where it is now or at the start of a word.

    >>> marked("R&un", "u"), marked("Run the recipe", "r"), marked("&Iteration on", "n"), marked("Run", "")
    ('R&un', '&Run the recipe', 'Iteratio&n on', 'Run')
    """
    if letter_of(text) == letter:
        return text
    text = text.replace("&", "")
    places = [at for at, one in enumerate(text) if one.lower() == letter]
    at = min(places, key=lambda at: (not _begins(text, at), at), default=None)
    return text if at is None else f"{text[:at]}&{text[at:]}"


def _give(at: int, texts: Sequence[str], holders: dict[str, int], closed: set[str]) -> bool:
    """Assign a free letter, or one whose owner can take another; letters of `closed`, which grows, are not tried."""
    simple = texts[at].replace("&", "")
    initials = [one for place, one in enumerate(simple) if _begins(simple, place)]
    offered = [one.lower() for one in (*initials, *simple) if one.isalnum()]
    free = next((one for one in offered if one not in holders), "")
    if free:
        holders[free] = at
        return True
    for letter in offered:
        if letter not in closed:
            closed.add(letter)
            if _give(holders[letter], texts, holders, closed):
                holders[letter] = at
                return True
    return False


def _begins(text: str, at: int) -> bool:
    return at == 0 or not text[at - 1].isalnum()
