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

    The first text with an ampersand before a letter has that letter. Each other text has the first letter of a word, or
    else any of its letters, that no text has yet.

    >>> letters(["Open &recent", "&Run", "Cut", "Compare", "Cu"])
    ['r', 'u', 'c', 'o', '']
    """
    written = [letter_of(text) for text in texts]
    taken, found = set(written), []
    for at, (text, letter) in enumerate(zip(map(without_mnemonic, texts), written, strict=True)):
        if not letter or letter in written[:at]:
            initials_first = sorted(range(len(text)), key=lambda at: not _begins_word(text, at))
            candidates = [text[place].lower() for place in initials_first if text[place].isalnum()]
            letter = next((one for one in candidates if one not in taken), "")
            taken.add(letter)
        found.append(letter)
    return found


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


def _begins_word(text: str, at: int) -> bool:
    return at == 0 or not text[at - 1].isalnum()
