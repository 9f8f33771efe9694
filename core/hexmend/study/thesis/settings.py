"""Values of parameters of a study that differ from the defaults of methods."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from hexmend.parameters import declared
from hexmend.smoothers import METHODS, Smoother


@dataclass(frozen=True)
class Settings:
    """Values of parameters for all methods of a study.

    Parameters
    ----------
    common : mapping of str to value
        Value of each parameter, for methods that declare it.

    Examples
    --------
    >>> settings = Settings({"offset": 0.0, "weights": "paper"})
    >>> settings.of("getme").weights, settings.of("local-nr").offset, settings.of("local-nr", delta=0.2).delta
    ('paper', 0.0, 0.2)
    """

    common: Mapping[str, Any] = field(default_factory=dict)

    def of(self, name: str, **others: Any) -> Smoother:
        """Make a method with these values, and with others as far as it declares them."""
        cls = METHODS[name]
        known = {parameter.name for parameter in declared(cls)}
        return cls(**{key: value for key, value in {**self.common, **others}.items() if key in known})
