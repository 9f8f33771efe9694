"""Functions that classes of lower layers call and higher layers provide: quality of a mesh, HTML for notebooks.

`hexmend/__init__.py` names the providers, so that no layer imports one above it.
"""

from __future__ import annotations

from importlib import import_module

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any

_PROVIDERS: dict[str, str] = {}


def register_hooks(**providers: str) -> None:
    """Name the functions of hooks, each as "module:function"; a module is imported when its hook is first used."""
    _PROVIDERS.update(providers)


def hook(name: str) -> Callable[..., Any]:
    """Import the function of a hook, given the name under which `register_hooks` has it."""
    module, _, function = _PROVIDERS[name].partition(":")
    return getattr(import_module(module), function)
