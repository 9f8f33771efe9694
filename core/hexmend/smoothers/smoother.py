"""What a smoother is, and the registry of them."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Generator
from dataclasses import dataclass
from typing import Any, ClassVar, TypeAlias, TypeVar

from hexmend.mesh import Mesh
from hexmend.optimise import Outcome, Step
from hexmend.parameters import Parametrised, declared
from hexmend.quality import ElementQuality
from hexmend.registry import Registry

#: What a smoother's `steps` gives.
Steps: TypeAlias = Generator[Step, None, Outcome | None]


@dataclass(frozen=True)
class Smoother(Parametrised, ABC):
    """A method that moves the free nodes of a mesh.

    A smoother is a frozen dataclass of declared parameters with one method, `steps`. It owns no clock, no limit, no
    record and no window: `hexmend.run` does.
    """

    name: ClassVar[str]
    title: ClassVar[str]
    help: ClassVar[str]
    source: ClassVar[str]
    #: Whether it goes to a minimum of the energy.
    optimises: ClassVar[bool] = False
    #: Names of the methods that this one may hand over to.
    uses: ClassVar[tuple[str, ...]] = ()

    @abstractmethod
    def steps(self, mesh: Mesh) -> Steps:
        """Yield the initial points once what the method prepares is ready, then the points after each step.

        The generator goes on until nobody asks for more, or returns the outcome where the method has no further step.
        Yielded arrays are never changed afterwards; rows of fixed nodes stay as they are to the last bit.
        """

    def rank(self, start: ElementQuality, now: ElementQuality) -> tuple[float, ...] | None:
        """What an iterate is kept for, the lower the better; None for a method whose last iterate is its result."""
        return None

    @classmethod
    def to_json(cls) -> dict[str, Any]:
        """The method's entry in `hexmend methods --json`."""
        parameters = [declaration.to_json() for declaration in declared(cls)]
        return {"name": cls.name, "title": cls.title, "help": cls.help, "source": cls.source, "parameters": parameters}


S = TypeVar("S", bound=type[Smoother])

METHODS: Registry[type[Smoother]] = Registry("method")


def method(cls: S) -> S:
    """Class decorator: register a smoother under its name."""
    METHODS.add(cls.name, cls)
    return cls
