"""Mnemonics of menu entries, made distinct in each menu: features choose theirs independently."""

from __future__ import annotations

from collections.abc import Sequence


def letter_of(text: str) -> str:
    """Return the mnemonic of a text in lower case; "" if it has none.

    >>> letter_of("R&un"), letter_of("Run")
    ('u', '')
    """
    return text.partition("&")[2][:1].lower()


def without_mnemonic(text: str) -> str:
    """Return a text without the ampersand of its mnemonic."""
    return text.replace("&", "")


def letters(texts: Sequence[str]) -> list[str]:
    """Return distinct mnemonics for the texts of a menu in lower case; "" if no letter is left.

    A letter after an ampersand is assigned to the first text that has it there. The other texts are assigned the first
    letters of their words, or any of their letters if those are taken.

    >>> letters(["Open &recent", "&Run", "Cut", "Compare", "Cu"])
    ['r', 'u', 't', 'o', 'c']
    """
    owners: dict[str, int] = {}  # indices of texts by letter
    for at, text in enumerate(texts):
        owners.setdefault(letter_of(text), at)
    owners.pop("", None)
    marked = set(owners.values())
    for at in range(len(texts)):
        if at not in marked:
            _assign(at, texts, owners, {letter_of(texts[index]) for index in marked})
    assigned = {at: letter for letter, at in owners.items()}
    return [assigned.get(at, "") for at in range(len(texts))]


def with_mnemonic(text: str, letter: str) -> str:
    """Return a text with an ampersand before a letter, preferably where it is now or at the start of a word.

    >>> with_mnemonic("R&un", "u"), with_mnemonic("Run the recipe", "r"), with_mnemonic("&Iteration on", "n")
    ('R&un', '&Run the recipe', 'Iteratio&n on')
    >>> with_mnemonic("Run", "")
    'Run'
    """
    if letter_of(text) == letter:
        return text
    text = without_mnemonic(text)
    places = [at for at, character in enumerate(text) if character.lower() == letter]
    at = min(places, key=lambda at: (not _begins_word(text, at), at), default=None)
    return text if at is None else f"{text[:at]}&{text[at:]}"


def _assign(at: int, texts: Sequence[str], owners: dict[str, int], closed: set[str]) -> bool:
    """Assign a free letter, or one whose owner can take another; return True on success.

    Letters in `closed` are not tried; those that are tried are added to it.
    """
    text = without_mnemonic(texts[at])
    initials = [character for place, character in enumerate(text) if _begins_word(text, place)]
    candidates = [character.lower() for character in (*initials, *text) if character.isalnum()]
    free = next((letter for letter in candidates if letter not in owners), "")
    if free:
        owners[free] = at
        return True
    for letter in candidates:
        if letter not in closed:
            closed.add(letter)
            if _assign(owners[letter], texts, owners, closed):
                owners[letter] = at
                return True
    return False


def _begins_word(text: str, at: int) -> bool:
    return at == 0 or not text[at - 1].isalnum()
