"""Hexmend: quality, smoothing and untangling of hexahedral meshes.

>>> import hexmend as hx
>>> mesh = hx.gallery.make("five-side", size=500)
>>> result = hx.smooth(mesh, "local-sd")
>>> result.after.q_mean > result.before.q_mean
True

Names are imported when they are first used: a command that computes nothing does not wait for NumPy. Beside those of
`__all__` the class of every registered method is here under its own name, such as `hx.LocalSteepestDescent`.
"""

from importlib import import_module

from hexmend import hooks

__version__ = "1.0.0"

hooks.register_hooks(
    fixed_sets="hexmend.mesh.fixing:fixed_sets",
    html="hexmend.notebook:html",
    plot="hexmend.notebook:plot",
    quality="hexmend.quality:metric_values",
    region="hexmend.quality.selection:region",
    summary="hexmend.quality:summarise",
    with_rules="hexmend.mesh.rules.resolution:with_rules",
    worst_hexes="hexmend.quality:worst_hexes",
)

#: Module of each name, as the stub says that type checkers read.
with open(__file__.removesuffix(".py") + ".pyi", encoding="utf-8") as _stub:
    _words = (line.split() for line in _stub if line.startswith("from "))
    _HOME_OF = {words[-1]: words[1] for words in _words}

__all__ = [name for name, home in _HOME_OF.items() if not home.startswith("hexmend.smoothers.")]


def __getattr__(name: str) -> object:
    if name in _HOME_OF:
        home = _HOME_OF[name]
        return import_module(f"{home}.{name}") if home == __name__ else getattr(import_module(home), name)
    for smoother in () if name.startswith("_") else import_module("hexmend.smoothers").METHODS.values():
        if smoother.__name__ == name:
            return smoother
    near = "" if name.startswith("_") else import_module("hexmend.parameters").suggestion(name, __all__)
    hint = f": {near.rstrip()}" if near else ""
    # named for its spec: for the module itself Python would add a hint
    raise AttributeError(f"module 'hexmend' has no attribute {name!r}{hint}", obj=__spec__)


def __dir__() -> list[str]:
    from hexmend.smoothers import METHODS

    return sorted({*__all__, *(smoother.__name__ for smoother in METHODS.values())})
