"""A study's choices where methods have others by default."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from hexmend.parameters import declared
from hexmend.smoothers import METHODS, Smoother


@dataclass(frozen=True)
class Settings:
    """Values of parameters.

    Parameters
    ----------
    common : mapping of str to value
        Of every method that declares the parameter.

    Examples
    --------
    >>> settings = Settings({"offset": 0.0, "weights": "paper"})
    >>> settings.of("getme").weights, settings.of("local-nr").offset, settings.of("local-nr", delta=0.2).delta
    ('paper', 0.0, 0.2)
    """

    common: Mapping[str, Any] = field(default_factory=dict)

    def of(self, name: str, **more: Any) -> Smoother:
        """A method with these values, and with `more` as far as it declares them."""
        cls = METHODS[name]
        known = {one.name for one in declared(cls)}
        return cls(**{key: value for key, value in {**self.common, **more}.items() if key in known})
