"""The run of a smoother or recipe: its steps become iterations with times, quality, limits and an outcome."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import pairwise

from hexmend.boundary import departures, surface_change
from hexmend.doctor import PROBLEMS
from hexmend.iteration import Iteration, Outcome, Result, StoppingCriteria
from hexmend.layers import LayerReport, Layers
from hexmend.locking import describe_overlap
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.orientation import check_orientation
from hexmend.mesh.rules import MotionRules
from hexmend.mesh.rules.resolution import with_more_rules
from hexmend.mesh.solid_cells import nouns
from hexmend.quality import Summary, describe_regressions, measure, measure_against_target, summarise
from hexmend.quality.material_volumes import MaterialVolume, volume_changes
from hexmend.run.interface_messages import interface_message
from hexmend.run.messages import describe_change, invalid_phrase, kept_message, name_invalid
from hexmend.run.recipe import Recipe, Stage
from hexmend.run.shape_watch import ShapeWatch
from hexmend.run.stage_run import StageRun
from hexmend.smoothers import METHODS, Smoother
from hexmend.terminal_text import count_phrase


class Run(Iterator[Iteration]):
    """Iterator of the iterations of a smoother or recipe on a mesh; keeps the history and the outcome.

    The stages of a recipe share one numbering, one clock and one history. Each begins with the result of the stage
    before it; a stage with nothing to do is skipped.

    Parameters
    ----------
    mesh : Mesh
    smoother : Smoother or Recipe
    stop : StoppingCriteria, optional
        The limits; the defaults for a smoother if None. For a recipe they replace those of every stage.

    Raises
    ------
    MeshError
        If hexes are numbered left-handed; see `hexmend.mesh.orientation.check_orientation`.

    Attributes
    ----------
    mesh, smoother
        As given; the mesh has the rules of motion of a recipe, and where a stage slides, its periodic pairs move as
        one.
    start : Iteration
        Number 0: the mesh as given.
    last : Iteration
        The newest iteration.
    best : Iteration
        The run's result: the best iteration of the current stage by the method's rank, of equal ones the latest; with
        `StoppingCriteria.keep_last` always the latest.
    history : list of dict
        `Iteration.row` of every iteration so far, number 0 first.
    outcome : Outcome or None
        The outcome of the last stage; None until the run ends.
    decisions : list of str
        Decisions of methods and changes of the method so far, as sentences.
    """

    def __init__(self, mesh: Mesh, smoother: Smoother | Recipe, stop: StoppingCriteria | None = None):
        if isinstance(smoother, Recipe) and smoother.rules:
            mesh = with_more_rules(mesh, smoother.rules)
        self.smoother = smoother
        self._stages = _stages(smoother, stop)
        if mesh.periodic_pairs and any(stage.smoother.slides for stage in self._stages):
            mesh = with_more_rules(mesh, MotionRules(periodic=mesh.periodic_pairs))
        self.mesh = mesh
        diagnostics = {"stage": 1, "method": self._stages[0].smoother.name}
        quality = measure(mesh.points, mesh.elements, mesh.mid_nodes)
        if quality.n_inverted:
            check_orientation(mesh)
        self._shapes = ShapeWatch(mesh, quality)
        smoother = self._stages[0].smoother
        judged = measure_against_target(self._shapes.with_target(smoother), mesh.points, quality)
        start = Iteration(0, mesh.points, quality, 0.0, 0.0, diagnostics, smoother.norm, judged)
        self.outcome: Outcome | None = None
        self.decisions: list[str] = []
        self._with_valid_mid_nodes: Mesh | None = None  # see `move_mid_nodes`
        self._stage_runs = [self._stage_of(self._stages[0], 1, start, start)]
        self.start = replace(start, surface=self._stage_run.start_surface)
        self.history = [self.start.row()]
        self._note_ignored()
        self._end_if_done()

    def __next__(self) -> Iteration:
        while self.outcome is None:
            if self._stage_run.outcome is not None:
                self._begin_next_stage()
                continue
            iteration = self._stage_run.advance()
            if iteration is not None:
                self.history.append(iteration.row())
                if self._stage_run.decision:
                    self.decisions.append(self._stage_run.decision)
            self._end_if_done()
            if iteration is not None:
                return iteration
        raise StopIteration

    def __repr__(self) -> str:
        at = f"iteration {self.last.number:,} of at most {self.max_iterations:,}"
        return f"<Run of {self.smoother.name}: {at}, {self.last.invalid:,} invalid>"

    def switch_method(self, smoother: Smoother | str, stop: StoppingCriteria | None = None) -> None:
        """Continue the current stage with another method, other parameters or other limits.

        The stage continues from the newest iteration, even if it has just ended, as far as the new limits allow.
        `decisions` gets a sentence, and the result names each method.

        Parameters
        ----------
        smoother : Smoother or str
        stop : StoppingCriteria, optional
            Limits of the whole stage, counted from its beginning; unchanged if None.

        Raises
        ------
        ValueError
            If the run has ended.
        """
        if self.outcome is not None:
            raise ValueError("the run has ended: begin another one with its result")
        old = self._stage_run
        new = Stage(METHODS[smoother]() if isinstance(smoother, str) else smoother, stop or old.stage.stop)
        if new == old.stage:
            return
        self.decisions.append(f"After iteration {self.last.number}: {describe_change(old.stage, new)}.")
        if new.smoother == old.smoother and old.outcome is None:
            old.set_limits(new.stop)
        else:
            stage_run = self._stage_of(new, old.number, old.current, self.last, old)
            if old.outcome is None:
                old.end(Outcome.STOPPED)
            self._stage_runs.append(stage_run)
        self._end_if_done()

    def close(self, keep_last: bool = False) -> None:
        """End the run after the newest iteration; it keeps its result, or with `keep_last` that iteration."""
        if self.last.number >= len(self.history):  # Ctrl-C came before the iteration was recorded
            self.history.append(self.last.row())
        if self.outcome is None:
            if keep_last and self.best is not self.last:
                self._stage_run.set_limits(replace(self._stage_run.stage.stop, keep_last=True))
            if self._stage_run.outcome is None:
                self._stage_run.end(Outcome.STOPPED)
            self.outcome = Outcome.STOPPED

    def move_mid_nodes(self) -> None:
        """Move the mid-nodes of the result where hexes are invalid between sound corners; those of iterations stay."""
        mesh = self._result_mesh
        if mesh.mid_nodes is not None and self.best.quality.n_invalid:
            moved = PROBLEMS["mid-nodes"].mend(mesh)
            self._with_valid_mid_nodes = None if moved is mesh else moved.with_element_target(mesh.element_target)

    @property
    def last(self) -> Iteration:
        """See the class."""
        return self._stage_run.last

    @property
    def best(self) -> Iteration:
        """See the class."""
        return self._stage_run.best

    @property
    def stage(self) -> Stage:
        """The current method and its limits."""
        return self._stage_run.stage

    @property
    def stage_number(self) -> int:
        """Number of the current stage, from 1."""
        return self._stage_run.number

    @property
    def stage_count(self) -> int:
        """Number of stages."""
        return len(self._stages)

    @property
    def max_iterations(self) -> int:
        """Largest number of iterations that the run can have with its present limits."""
        at = self._stage_run
        limit = at.stage_start.number + at.stage.stop.limit_of(at.smoother)
        here = limit if at.outcome is None else self.last.number
        return here + sum(stage.stop.limit_of(stage.smoother) for stage in self._remaining_stages)

    @property
    def setup_seconds(self) -> float:
        """Seconds that the methods took for their preparations so far."""
        return sum(one.setup_seconds for one in self._stage_runs)

    @property
    def recipe(self) -> Recipe:
        """Recipe that repeats the run, with the stages still to come."""
        own = [one.as_stage(cut=later.number == one.number) for one, later in pairwise(self._stage_runs)]
        stages = (*own, self._stage_run.as_stage(), *self._remaining_stages)
        title = self.smoother.title if isinstance(self.smoother, Recipe) else ""
        begun = (stage for stage in stages if stage is not None)
        return Recipe.of(*begun, title=title, rules=self.mesh.node_rules.rules)

    @property
    def message(self) -> str:
        """Result, reason of the end, and figures that are worse than before, as sentences."""
        volumes = volume_changes(self.mesh, self.mesh.with_points(self.best.points))
        walls = self._shapes.reports(self.stage.smoother, self.best.points)
        return self._message(*self._summaries(), volumes, walls)

    def _message(
        self, before: Summary, after: Summary, volumes: Mapping[str, MaterialVolume], walls: tuple[LayerReport, ...]
    ) -> str:
        at, inverted, invalid = self.last, after.inverted, after.invalid
        text = self.outcome.value if self.outcome is not None else "Running."
        left = invalid_phrase(inverted, invalid, nouns(self.mesh.elements))
        cut_short = self.outcome is None or self.outcome.is_cut_short  # else the last step may be back to the result
        longest = at.largest_move if at.number and cut_short else 0.0
        move = f"the last one moved nodes by up to {longest:.2g} mean edge lengths; " if longest else ""
        decided = self.decisions
        if not self._kept_last and decided and decided[-1] == self._stage_run.decision:
            decided = decided[:-1]  # it is about the last iteration, which is not the result
        words = [text, f"{count_phrase(at.number, 'iteration')} in {at.seconds:.3g} s; {move}{left}.", *decided]
        if not self._kept_last:
            words.append(kept_message(self.best.number))
        words.append(interface_message(self.mesh, self.mesh.with_points(self.best.points), volumes))
        if self._with_valid_mid_nodes is not None:
            valid = count_phrase(self.best.quality.n_invalid - invalid, "hex", "hexes")
            words.append(f"Mid-nodes inside the mesh were moved, which made {valid} of second order valid.")
        target_q = self._target_q
        words.append(describe_regressions(before, after, target_q))
        if invalid:
            mesh = self._result_mesh
            words.append(name_invalid(mesh, measure(mesh.points, mesh.elements, mesh.mid_nodes)))
            words.append(describe_overlap(self.mesh))
        result = None if self.outcome is None else self._result_mesh
        words.append(self._shapes.message(self.stage.smoother, walls, result))
        return " ".join(filter(None, words))

    @property
    def _result_mesh(self) -> Mesh:
        if self._with_valid_mid_nodes is not None:
            return self._with_valid_mid_nodes
        return self.mesh.with_points(self.best.points).with_element_target(self._stage_run.target)

    @property
    def _kept_last(self) -> bool:
        return self.best is self.last

    def result(self) -> Result:
        """Return the result so far."""
        before, after = self._summaries()
        several = isinstance(self.smoother, Recipe) or len(self._stage_runs) > 1
        mesh = self._result_mesh
        mesh._set(_invalid=after.invalid)  # for its representation
        volumes = volume_changes(self.mesh, mesh)
        walls, sliding = self._shapes.reports(self.stage.smoother, self.best.points), self._sliding_smoother
        return Result(
            mesh=mesh,
            before=before,
            after=after,
            method=Recipe.name if several else self.smoother.name,
            parameters={} if several else self.stage.smoother.values(),
            outcome=self.outcome or Outcome.STOPPED,
            message=self._message(before, after, volumes, walls),
            iterations=self.last.number,
            kept=self.best.number,
            seconds=self.last.seconds,
            setup_seconds=self.setup_seconds,
            history=tuple(self.history),
            stages=tuple(one.result() for one in self._stage_runs),
            surface=None if sliding is None else surface_change(self.mesh, mesh, sliding.feature_angle),
            departures=None if sliding is None else departures(self.mesh, mesh, sliding.feature_angle, sliding.slides),
            materials=volumes,
            active=self._stage_run.active if self._kept_last else None,
            layers=walls,
            target_q=self._target_q,
        )

    @property
    def _sliding_smoother(self) -> Smoother | None:
        """The first method that let the boundary slide."""
        by_rule = self.mesh.node_rules.slides is not None
        return next((one.smoother for one in self._stage_runs if one.smoother.slides or by_rule), None)

    @property
    def _target_q(self) -> tuple[float, float] | None:
        """Least q of target of the mesh as given and of the result; None without a target."""
        return self._shapes.target_q(self._stage_run.target, self.start, self.best)

    @property
    def layers(self) -> Layers:
        """Boundary layers of the mesh as given: on walls that the current stage names, or those that are found."""
        return self._shapes.layers_of(self.stage.smoother)

    @property
    def layers_message(self) -> str:
        """The layers that were found and whether the run keeps them, as a sentence; "" without layers."""
        stages = [*(one.stage for one in self._stage_runs), *self._remaining_stages]
        return self._shapes.layers_message([stage.smoother for stage in stages])

    def _summaries(self) -> tuple[Summary, Summary]:
        """Return the summaries of the mesh as given and of the result."""
        quality = None if self._with_valid_mid_nodes is not None else self.best.quality
        return summarise(self.mesh, self.start.quality), summarise(self._result_mesh, quality)

    def _stage_of(self, stage: Stage, number: int, start: Iteration, last: Iteration, *old: StageRun) -> StageRun:
        """Begin a stage; its target is made from the mesh as given, whatever earlier stages have done."""
        return StageRun(self._shapes.with_target(stage.smoother), stage, number, start, last, *old)

    @property
    def _stage_run(self) -> StageRun:
        return self._stage_runs[-1]

    @property
    def _remaining_stages(self) -> Sequence[Stage]:
        return self._stages[self._stage_run.number :]

    def _begin_next_stage(self) -> None:
        done, last, reached = self._stage_run, self.last, self.best
        kept = f" Iteration {reached.number} of it was kept." if reached is not last else ""
        count = count_phrase(last.number - done.stage_start.number, "iteration")
        outcome = "" if done.outcome is None else done.outcome.value
        self.decisions.append(f"Stage {done.number}, {done.smoother.title}, {count}: {outcome}{kept}")
        self._stage_runs.append(self._stage_of(self._remaining_stages[0], done.number + 1, reached, last))
        self._note_ignored()
        self._end_if_done()

    def _note_ignored(self) -> None:
        """Add a decision about parameters without effect, and a target of a method that minimises no energy."""
        smoother = self._stage_run.smoother
        if smoother.ignored_parameters:
            self.decisions.append(smoother.ignored_parameters)
        if self._stage_run.target is not None and not smoother.optimises:
            self.decisions.append(f"{smoother.title} takes no account of the target of the hexes.")

    def _end_if_done(self) -> None:
        """End the run if the current stage has ended and no other one follows."""
        outcome = self._stage_run.outcome
        if outcome is Outcome.NOTHING_FREE or (outcome is not None and not self._remaining_stages):
            self.outcome = outcome


def _stages(smoother: Smoother | Recipe, stop: StoppingCriteria | None) -> Sequence[Stage]:
    if isinstance(smoother, Recipe):
        return (smoother if stop is None else smoother.limited(**stop.values())).stages
    return (Stage(smoother, stop or StoppingCriteria()),)
