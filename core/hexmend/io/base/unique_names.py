"""Names of sets as a file can have them, no two of them alike."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from itertools import count


def make_unique(names: Iterable[str], form: Callable[[str, str], str]) -> dict[str, str]:
    """Each name as it is written.

    Parameters
    ----------
    names : iterable of str
    form : callable
        From a name and an end to the name, as a file can have it, with that end.

    Returns
    -------
    dict of name to str
        Names that a file can have are kept; others that become the same as an earlier one end in " 2", " 3"...

    Examples
    --------
    >>> make_unique(["a\'b", 'a"b'], lambda name, end: name.replace('"', "'") + end)
    {"a'b": "a'b", 'a"b': "a'b 2"}
    """
    names = list(dict.fromkeys(names))
    answer = {name: name for name in names if form(name, "") == name}
    taken = set(answer)
    for name in names:
        if name not in answer:
            answer[name] = next(
                title for k in count(1) if (title := form(name, "" if k == 1 else f" {k}")) not in taken
            )
            taken.add(answer[name])
    return {name: answer[name] for name in names}


def altered_names(titles: dict[str, str], of: str = "sets") -> list[str]:
    """That some names (of sets, or of what is said) are not written as they are, in words; nothing where all are."""
    other = sorted(name for name, title in titles.items() if name != title)
    return [f"names of {of} as they are ({', '.join(other)})"] if other else []
