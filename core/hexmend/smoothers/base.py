"""Base class of the smoothers, and their registry."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Generator
from dataclasses import dataclass
from typing import Any, ClassVar, TypeAlias, TypeVar

import numpy as np

from hexmend.boundary.feature_edges.features import FEATURE_ANGLE, FeatureAngle
from hexmend.energy.norm import SQUARES, ObjectiveNorm
from hexmend.iteration import Outcome, Step
from hexmend.layers import Layers
from hexmend.mesh.mesh import Mesh
from hexmend.parameters import Parametrised, declared
from hexmend.quality import ElementQuality
from hexmend.registry import Registry, load_entry_points

#: Type of the generator that `Smoother.steps` returns.
Steps: TypeAlias = Generator[Step, None, Outcome | None]


#: Function of the points (n, 3) that returns them with some nodes moved.
Sweep: TypeAlias = Callable[[np.ndarray], np.ndarray]

#: Least fall of q(H) that four decimals show: near its optimum an optimiser goes up and down by less.
_VISIBLE_FALL = 0.5e-4


@dataclass(frozen=True)
class Smoother(Parametrised, ABC):
    """Method that moves the free nodes of a mesh and, if its parameters say so, boundary nodes along the surface.

    A smoother is a frozen dataclass of declared parameters with one method, `steps`. Clock, limits
    and history belong to `hexmend.run`.
    """

    name: ClassVar[str]
    title: ClassVar[str]
    help: ClassVar[str]
    source: ClassVar[str]
    #: True for a method that goes to a minimum of the energy.
    optimises: ClassVar[bool] = False
    #: Iterations after which a run ends, unless another limit is set.
    iteration_limit: ClassVar[int] = 300
    #: True for a method whose steps keep the linear motion of a mesh; those of others are constrained afterwards, by
    #: `hexmend.smoothers.constrained_steps`.
    keeps_linear_motion: ClassVar[bool] = False
    #: Bytes per hex that its run needs at most in addition to the open mesh, topology included: measured by `hexmend
    #: bench --only memory`, with a fifth added. See `hexmend.run.memory`.
    bytes_per_hex: ClassVar[int] = 1000

    def __post_init__(self) -> None:
        _check_texts(type(self), "name", "title")
        super().__post_init__()

    @property
    def norm(self) -> ObjectiveNorm:
        """p and offset of the objective that its runs minimise.

        It is recorded for every step that names no other (`Step.norm`). A method that minimises nothing has the
        default values.
        """
        return SQUARES

    @property
    def feature_angle(self) -> FeatureAngle:
        """Dihedral angle, in degrees or auto, beyond which an edge of the boundary is a feature."""
        return FEATURE_ANGLE

    @property
    def slides(self) -> bool:
        """True if nodes of the boundary slide on the surface."""
        return False

    @property
    def keeps_layers(self) -> bool:
        """True if boundary layers keep their heights by a target."""
        return False

    @property
    def ignored_parameters(self) -> str:
        """Sentence about parameters that have no effect because of others; "" if all have one."""
        return ""

    def slides_on(self, mesh: Mesh) -> bool:
        """Return True if nodes of a mesh slide: of its boundary, or those for which its rules say so."""
        return self.slides

    def movable(self, mesh: Mesh) -> np.ndarray:
        """Mark the nodes that the method may move, (n,) bool: the free ones, and those that slide."""
        return mesh.free

    def layers_of(self, mesh: Mesh, found: Layers, quality: ElementQuality | None = None) -> Layers:
        """Return the layers of a mesh that count: those that were found, or those on walls that the parameters name.

        Parameters
        ----------
        mesh : Mesh
            As given to the run.
        found : Layers
            Of `hexmend.layers.find_layers`.
        quality : ElementQuality, optional
            Of its hexes.

        Raises
        ------
        ParameterError
            For a set that does not exist, and one without a face on the boundary.
        """
        return found

    def with_target(self, mesh: Mesh, layers: Layers, quality: ElementQuality | None = None) -> Mesh:
        """Return the mesh with the target of its hexes that the parameters name; the mesh itself by default.

        Parameters
        ----------
        mesh : Mesh
            As given to the run, not the result of an earlier stage.
        layers : Layers
            Its boundary layers.
        quality : ElementQuality, optional
            Of its hexes.

        Raises
        ------
        ParameterError
            For a target that the mesh cannot have.
        """
        return mesh

    @abstractmethod
    def steps(self, mesh: Mesh) -> Steps:
        """Yield the initial points once the method is prepared, then the points after each step.

        A run copies what is yielded, unless it is immutable already. Rows of nodes that the method may not move stay as
        they are to the last bit.

        Parameters
        ----------
        mesh : Mesh

        Yields
        ------
        Step

        Returns
        -------
        Outcome or None
            Outcome when the method has no further step; a run may close the generator earlier.
        """

    def constrained_sweep(self, mesh: Mesh, linear: np.ndarray) -> Sweep | None:
        """Make the sweep over nodes with a linear motion that follows each step of the method over the other nodes.

        Parameters
        ----------
        mesh : Mesh
        linear : (n,) bool
            The nodes.

        Returns
        -------
        callable or None
            Function of points (n, 3) that returns them with these nodes moved. None for a method without such a
            sweep: its steps are projected onto the admissible displacements.
        """
        return None

    def rank(self, start: ElementQuality, now: ElementQuality) -> tuple[float, ...]:
        """Sort key of an iterate: the smallest is kept, of equals the last.

        First comes whether more hexes are invalid than at the start, then the number of inverted ones and that of
        invalid ones, then the least q(H). Of an optimiser it counts only whether that is visibly lower than at the
        start: its iterates improve by the objective, not by the least q(H). With a target, q(H) is that against the
        target; of an optimiser it counts then whether the objective is higher than at the start.

        Parameters
        ----------
        start, now : ElementQuality
            At the beginning of the stage, and of the iterate; measured against the target of the mesh if it has one.

        Returns
        -------
        tuple of float
        """
        least, counts = float(now.q.min()), (now.n_invalid > start.n_invalid, now.n_inverted, now.n_invalid)
        if self.optimises and now.against_target:
            return *counts, objective_of_sound(now, self.norm) > objective_of_sound(start, self.norm)
        return *counts, least < start.q.min() - _VISIBLE_FALL if self.optimises else -least

    def rank_by_points(self, hexes: np.ndarray, points: np.ndarray) -> tuple[float, ...]:
        """Sort keys of an iterate after those of `rank`, which its quality alone does not determine; none by default.

        Parameters
        ----------
        hexes : (m, 8) int32
        points : (n, 3) float64
            Of the iterate.

        Returns
        -------
        tuple of float
        """
        return ()

    @classmethod
    def to_json(cls) -> dict[str, Any]:
        """The method's entry in `hexmend methods --json`."""
        parameters = [declaration.to_json() for declaration in declared(cls)]
        return {"name": cls.name, "title": cls.title, "help": cls.help, "source": cls.source, "parameters": parameters}


def figures_of_merit(quality: ElementQuality) -> np.ndarray:
    """Figures of merit that heuristics raise, (3,) float64: minus the number of inverted hexes, q_min, q_mean."""
    return np.array([-quality.n_inverted, quality.q.min(), quality.q.mean()])


def objective_of_sound(quality: ElementQuality, norm: ObjectiveNorm) -> float:
    """Objective over the hexes that are not inverted, of (3.3) without its root."""
    p, offset = norm
    with np.errstate(over="ignore"):  # close to the barrier
        return float(np.power(quality.eta[~quality.inverted] + (1 - offset), p).sum())


S = TypeVar("S", bound=type[Smoother])

#: The entry-point group through which other distributions add theirs: entries name a module or a smoother's class.
GROUP = "hexmend.smoothers"


def load_plugins() -> None:
    """Load the smoothers of other distributions."""
    load_entry_points(GROUP, "method", _take)


def _take(name: str, found: object) -> None:
    if isinstance(found, type) and found not in METHODS.values():  # a module announces its smoothers itself
        method(found)


METHODS: Registry[type[Smoother]] = Registry("method", load_plugins)
"""Methods by name; those of other distributions are loaded when all names are asked for."""


def _check_texts(cls: type, *names: str) -> None:
    """Raise `TypeError` where a class does not give a text under each of some names."""
    for name in names:
        if not isinstance(getattr(cls, name, None), str):
            raise TypeError(f"{cls.__name__} has no {name}: expected a text in the class")


def method(cls: S) -> S:
    """Register a smoother under its name: class decorator.

    Raises
    ------
    TypeError
        If the class lacks one of the texts name, title, help and source.
    ValueError
        If the name is already registered.
    """
    if not issubclass(cls, Smoother):
        raise TypeError(f"{cls.__name__} is not a hexmend.Smoother")
    _check_texts(cls, "name", "title", "help", "source")
    METHODS.add(cls.name, cls)
    return cls
