"""Methods as a user names them, with settings in words."""

from __future__ import annotations

import difflib
from collections.abc import Mapping, Sequence

from hexmend.errors import ParameterError
from hexmend.parameters import declared, from_strings
from hexmend.smoothers import METHODS, Smoother


def chosen(names: Sequence[str], settings: Mapping[str, str]) -> list[Smoother]:
    """Methods by name, each once, with settings in words.

    Parameters
    ----------
    names : sequence of str
    settings : mapping of str to str
        `key` is for every one of the methods that declares it, `method.key` for that one alone, and goes before.

    Raises
    ------
    ParameterError
        For an unknown method, a value out of bounds, or a key that none of the methods declares.

    Examples
    --------
    >>> [one.values().get("p") for one in chosen(["laplacian", "local-sd", "local-nr"], {"p": "4", "local-nr.p": "6"})]
    [None, 4.0, 6.0]
    """
    keys = {name: [one.name for one in declared(METHODS[name])] for name in names}
    words: dict[str, dict[str, str]] = {name: {} for name in keys}
    for setting in sorted(settings, key=lambda setting: "." in setting):
        owner, dot, key = setting.rpartition(".")
        key = key.replace("-", "_")
        if dot and owner not in keys:
            raise ParameterError(f"{setting!r}: {owner!r} is not among the methods compared: {', '.join(keys)}")
        takers = [owner] if dot else [name for name in keys if key in keys[name]]
        if not takers:
            near = difflib.get_close_matches(key, {one for several in keys.values() for one in several}, n=1)
            hint = f": did you mean {near[0]}?" if near else ""
            raise ParameterError(f"none of the methods {', '.join(keys)} has a parameter {key!r}{hint}")
        for name in takers:
            words[name][key] = settings[setting]
    return [from_strings(METHODS[name], words[name], owner=name) for name in keys]
