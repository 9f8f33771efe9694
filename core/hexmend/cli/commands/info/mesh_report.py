"""The report that `hexmend info` prints on a mesh.

Table of a solver's checks.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from hexmend.cli.commands.info.judgement import Judgement
from hexmend.cli.output.mesh_output import print_notes
from hexmend.cli.output.text_tables import print_columns, print_kinds, print_spreads, print_summaries
from hexmend.doctor import PROBLEMS, Finding, examine
from hexmend.io import read
from hexmend.layers import describe_layers, find_layers
from hexmend.mesh.materials import CONTACT_CARDS
from hexmend.mesh.mesh import Mesh
from hexmend.mesh.solid_cells import nouns
from hexmend.quality import ElementQuality, measure, metric_statistics, summarise
from hexmend.quality.material_volumes import material_volumes
from hexmend.quantity import format_count
from hexmend.terminal_text import WorsenedText, count_phrase, printable

if TYPE_CHECKING:
    from hexmend.locking import Locking
    from hexmend.solver_checks import Report

#: Places of a problem that are printed.
_MAX_PLACES = 10


def run(args: argparse.Namespace) -> int:
    """Measure the mesh and print the report, as text or as JSON."""
    if args.solver is not None:
        from hexmend.solver_checks import SOLVERS  # loaded only for --for

        args.solver = SOLVERS[args.solver.lower()].name  # raises before a long read
    mesh = read(args.mesh, as_is=args.as_is)
    print_notes(mesh)
    quality = measure(mesh.points, mesh.elements, mesh.mid_nodes)
    summary = summarise(mesh, quality)
    metrics = metric_statistics(mesh, quality) if args.metrics else {}
    layers = describe_layers(find_layers(mesh, quality), mesh, quality)
    locking = _locking(mesh, quality)
    checks = _check(mesh, args.solver, quality)
    findings = _examine(mesh, args.doctor, mesh.mid_nodes is not None and quality.n_invalid > 0)
    joined = CONTACT_CARDS in mesh.field_data  # or kept apart, by cards of the file
    faults = [finding for finding in findings if not (joined and finding.kind == "parts")]
    judgement = Judgement.of(args.mesh, quality, locking, faults, checks, words=nouns(mesh.elements))
    if args.json:
        from hexmend.report.records import to_json  # not loaded for a report in words

        answer: dict[str, Any] = summary.to_dict()
        if args.metrics:
            answer["metrics"] = {name: spread.to_dict() for name, spread in metrics.items()}
        answer |= _materials_record(mesh)
        answer |= {} if locking is None else {"locking": locking.to_dict()}
        answer |= {"layers": layers} if layers else {}
        if checks is not None:
            answer["checks"] = [result.to_dict() for result in checks.results]
            answer |= {"solver": checks.solver.name, "verdict": checks.verdict}
        if args.doctor:
            answer["doctor"] = [finding.to_dict(_MAX_PLACES) for finding in findings]
        print(to_json(answer | judgement.to_dict()))
        return 0
    print_summaries(args.mesh, [""], [summary])
    print_kinds(summary.cells)
    if locking is not None:
        _print_locked(args, mesh, locking)
    if mesh.materials is not None:
        _print_materials(mesh)
    if mesh.embedded.any():
        from hexmend.run.interface_messages import describe_embedded

        print(describe_embedded(mesh))
    for wall in layers:
        print(_layer_line(wall))
    if args.metrics:
        print_spreads(metrics)
    if checks is not None:
        print_checks(checks)
    _print_problems(args, mesh, findings)
    print(printable(judgement.line))
    return 0


def _materials_record(mesh: Mesh) -> dict[str, Any]:
    """Return the materials of a mesh with several, with their numbers of hexes and volumes."""
    if mesh.materials is None:
        return {}
    counts, volumes = np.bincount(mesh.materials.of_hex).tolist(), material_volumes(mesh).items()
    pairs = zip(volumes, counts, strict=True)
    materials = {name: {"hexes": count, "volume": volume} for (name, volume), count in pairs}
    return {"materials": materials, "interface_nodes": int(np.count_nonzero(mesh.materials.interface_nodes))}


def _examine(mesh: Mesh, all_searches: bool, is_bent: bool) -> tuple[Finding, ...]:
    """Return the doctor's findings; those of mid-nodes also in a quick search where a Jacobian is not positive."""
    findings = examine(mesh, quick=not all_searches)
    bent = PROBLEMS["mid-nodes"].find(mesh) if is_bent and not all_searches else None
    return findings if bent is None else (*findings, bent)


def _print_materials(mesh: Mesh) -> None:
    """Print the materials with their numbers of hexes, and what happens to the interfaces between them."""
    from hexmend.run.interface_messages import describe_interfaces

    materials = mesh.materials
    counts = np.bincount(materials.of_hex).tolist()
    named = [f"{name} ({count:,})" for name, count in zip(materials.names, counts, strict=True)]
    more = len(named) - _MAX_PLACES
    listed = ", ".join(named[:_MAX_PLACES]) + (f" and {more:,} more" if more > 0 else "")
    print(f"{describe_interfaces(mesh)} {nouns(mesh.elements)[1].capitalize()}: {printable(listed)}.")


def _check(mesh: Mesh, solver: str | None, quality: ElementQuality) -> Report | None:
    """Judge the mesh by the checks of a solver, if one is named."""
    if solver is None:
        return None
    from hexmend.solver_checks import check_mesh  # loaded only for --for

    return check_mesh(mesh, solver, quality)


def _layer_line(wall: dict[str, Any]) -> str:
    return (
        f"Layers at '{wall['wall']}': {wall['layers']} on {count_phrase(wall['faces'], 'face')}, first height "
        f"{wall['first_height_mean']:.4g} (least {wall['first_height_min']:.4g}), growth {wall['growth']:.3f}, "
        f"{wall['angle_mean']:.1f}° from the wall's normal."
    )


def _locking(mesh: Mesh, quality: ElementQuality) -> Locking | None:
    """Return the locked hexes, and what frees them; None where there are none."""
    if quality.scaled_jacobian.min() > 0.01:
        return None
    from hexmend.locking import find_locking  # loaded only for a mesh with hexes that are inverted or flat

    found = find_locking(mesh, quality=quality)
    return found if found.hexes.size else None


def _print_locked(args: argparse.Namespace, mesh: Mesh, locking: Locking) -> None:
    """Print how many locked hexes sliding may free, and with --doctor the proofs for the others."""
    print(f"{locking.phrase}.")
    if args.doctor:
        for corner in locking.corners[:_MAX_PLACES]:
            print(f"      {corner.describe(mesh)}")
        more = len(locking.corners) - _MAX_PLACES
        if more > 0:
            print(f"      ... and {more:,} more corners; --json lists them all.")


def _print_problems(args: argparse.Namespace, mesh: Mesh, findings: Sequence[Finding]) -> None:
    if args.doctor and not findings:
        print("The doctor finds no problems. Use hexmend smooth to improve the shape of cells.")
    for finding in findings:
        print(f"note: {finding.message} {finding.remedy}".rstrip())
        if args.doctor and finding.location_text():
            print(f"      {finding.location_text(_MAX_PLACES, mesh)}")
        if args.doctor and finding.mendable:
            print(f"      hexmend repair {args.mesh} -o OUT --only {finding.kind}")


def print_checks(report: Report) -> None:
    """Print each check with value, limit and count, then the verdict, what is left out, and a reservation."""
    rows = []
    for result in report.results:
        painted = WorsenedText if result.count else str
        beyond = f"{format_count(result.count)} of {format_count(result.total)} {result.check.unit_of_count}"
        value = f"{result.value:.4g}".replace("inf", "∞")
        counted = "–" if result.check.limit is None else beyond
        verdict = painted(_VERDICTS[result.verdict])
        rows.append([result.check.name, value, result.check.limit_text, result.check.unit or "–", counted, verdict])
    print_columns(["Check", "Worst", "Limit", "Unit", "Beyond", "Verdict"], rows)
    print(report.sentence)
    print(f"note: {report.solver.tests_validity}")
    print(f"note: {report.solver.omitted}")
    if report.solver.reservation:
        print(f"note: Limits and factors are {report.solver.reservation}.")


_VERDICTS = {"passed": "passed", "warning": "warning", "failed": "failed", "value": "no limit"}
